// SPDX-License-Identifier: MIT
// A file of the steps of a run, from which the run can be gone on with after whatever ended it
// (docs/interrupted_runs.md).
//
// Blocks: the number of bytes (8), the CRC-32 of that number and of the bytes (4), the bytes. The first block says what
// wrote the file, each of the others is one step. Numbers are as they are in memory: the file is for the machine it was
// written on.
#pragma once

#include "../step_record.hpp"
#include "atomic_file.hpp"

#include <boost/crc.hpp>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <istream>
#include <limits>
#include <memory>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

namespace axistokes {

namespace detail {

/// Appends values to `bytes`, or takes them from its front: one description of an object does for both.
class Archive {
  public:
    enum class Way { write, read };

    Archive(std::string& bytes, Way way) : bytes_(bytes), way_(way) {}

    template <class... T>
    void operator()(T&... values) {
        (one(values), ...);
    }
    bool exhausted() const { return at_ == bytes_.size(); }

  private:
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void one(T& value) { copy(&value, sizeof(T)); }

    template <class T>
    requires requires(T& values) {
        values.resize(values.size());
        values.data();
    }
    void one(T& values) {
        auto size = values.size();
        one(size);
        if (way_ == Way::read) {
            // An element takes a byte at least: what is no size of theirs is not allocated.
            require_left(static_cast<std::size_t>(size));
            values.resize(size);
        }
        using Element = std::remove_reference_t<decltype(*values.data())>;
        if constexpr (std::is_trivially_copyable_v<Element>) {
            copy(values.data(), static_cast<std::size_t>(size) * sizeof(Element));
        } else {
            for (Element& value : values) {
                one(value);
            }
        }
    }

    template <class S>
    void one(Meridian<S>& shape) {
        (*this)(shape.r, shape.z);
    }
    template <class S>
    void one(Configuration<S>& body) {
        (*this)(body.shape, body.position, body.tension, body.reference);
    }
    template <class S>
    void one(RecordedStep<S>& step) {
        (*this)(step.step, step.begin, step.shortened, step.refused, step.failure, step.planned, step.resolved,
                step.report, step.bodies, step.records, step.motion, step.wall);
    }

    void require_left(std::size_t size) const {
        if (size > bytes_.size() - at_) {
            throw InvalidArgument("recorded step: has fewer bytes than its contents");
        }
    }

    void copy(void* value, std::size_t size) {
        if (way_ == Way::write) {
            bytes_.append(static_cast<const char*>(value), size);
        } else if (size > 0) {
            require_left(size);
            std::memcpy(value, bytes_.data() + at_, size);
            at_ += size;
        }
    }

    std::string& bytes_;
    Way way_;
    std::size_t at_ = 0;
};

inline std::uint32_t block_checksum(std::uint64_t size, const std::string& bytes) {
    boost::crc_32_type crc;
    crc.process_bytes(&size, sizeof(size));
    crc.process_bytes(bytes.data(), bytes.size());
    return crc.checksum();
}

inline std::string block_of(const std::string& bytes) {
    std::uint64_t size = bytes.size();
    std::uint32_t checksum = block_checksum(size, bytes);
    std::string block;
    Archive(block, Archive::Way::write)(size, checksum);
    return block + bytes;
}

/// Of the `left` bytes that are left, which it makes fewer; none if they do not begin with a block as it was written.
inline std::optional<std::string> read_block(std::istream& in, std::uint64_t& left) {
    std::string head(sizeof(std::uint64_t) + sizeof(std::uint32_t), '\0');
    if (left < head.size() || !in.read(head.data(), static_cast<std::streamsize>(head.size()))) {
        return std::nullopt;
    }
    std::uint64_t size = 0;
    std::uint32_t checksum = 0;
    Archive(head, Archive::Way::read)(size, checksum);
    if (size > left - head.size()) {
        return std::nullopt;
    }
    std::string bytes(static_cast<std::size_t>(size), '\0');
    if (!in.read(bytes.data(), static_cast<std::streamsize>(size)) || block_checksum(size, bytes) != checksum) {
        return std::nullopt;
    }
    left -= head.size() + bytes.size();
    return bytes;
}

}  // namespace detail

/// Whatever ends a program, the steps flushed before are in the file; what was being written then is dropped when the
/// run is gone on with. (If the whole machine fails, what its system has not written yet is missing as well.)
template <class S>
requires std::is_trivially_copyable_v<S>
class StepJournal : public StepRecorder<S> {
  public:
    /// A new file, in place of one that may be there. `text` is for whoever goes on with the run; steps are flushed
    /// after each `every`. Throws InvalidArgument unless that is at least 1, and OutputError.
    static std::shared_ptr<StepJournal> create(const std::filesystem::path& path, const std::string& text = {},
                                               Index every = 1) {
        detail::require(every >= 1, "steps from one flush of the journal to the next", every, "at least 1");
        Header header{mark, format, version, sizeof(S), std::numeric_limits<S>::digits, text};
        std::string bytes;
        header.archive(detail::Archive(bytes, detail::Archive::Way::write));
        write_atomically(path, [&](std::ostream& out) { out << detail::block_of(bytes); });
        return resume(path, every);
    }

    /// Goes on with a file: its steps are repeated, more are appended. The end of the file is cut off from the first
    /// step on that is not as it was written. Throws InvalidArgument for a file that is none of these, or of another
    /// version or type of numbers, and OutputError.
    static std::shared_ptr<StepJournal> resume(const std::filesystem::path& path, Index every = 1) {
        return std::shared_ptr<StepJournal>(new StepJournal(path, every));
    }

    StepJournal(const StepJournal&) = delete;
    StepJournal& operator=(const StepJournal&) = delete;
    ~StepJournal() override {
        try {
            flush();
        } catch (const OutputError&) {
            // Whoever wants to know flushes before.
        }
    }

    const std::filesystem::path& path() const { return path_; }
    const std::string& text() const { return text_; }

    /// Throws InvalidArgument if there is something else in its place.
    std::optional<RecordedStep<S>> next() override {
        if (!in_.is_open()) {
            return std::nullopt;
        }
        auto bytes = detail::read_block(in_, left_);
        if (!bytes) {
            in_.close();
            return std::nullopt;
        }
        RecordedStep<S> step;
        detail::Archive archive(*bytes, detail::Archive::Way::read);
        archive(step);
        detail::require(archive.exhausted(), "recorded step", step.step, "as long as its contents");
        return step;
    }

    /// Throws OutputError; the step is lost then, and all that are not flushed.
    void append(RecordedStep<S> step) override {
        std::string bytes;
        detail::Archive(bytes, detail::Archive::Way::write)(step);
        pending_ += detail::block_of(bytes);
        if (++steps_pending_ >= every_) {
            flush();
        }
    }

    /// Hands all steps to the system. Throws OutputError.
    void flush() {
        if (pending_.empty()) {
            return;
        }
        errno = 0;
        out_ << std::exchange(pending_, {}) << std::flush;
        steps_pending_ = 0;
        if (!out_) {
            const int cause = errno;
            throw OutputError(path_, cause != 0 ? std::error_code(cause, std::generic_category())
                                                : std::make_error_code(std::errc::io_error));
        }
    }

    /// Deletes the file: the run has come to its end. Throws OutputError.
    void remove() {
        pending_.clear();
        in_.close();
        out_.close();
        std::error_code error;
        std::filesystem::remove(path_, error);
        if (error) {
            throw OutputError(path_, error);
        }
    }

  private:
    static constexpr const char* mark = "axistokes journal of steps";
    /// To be raised with any change of RecordedStep and its parts.
    static constexpr std::uint32_t format = 1;

    struct Header {
        std::string mark;
        std::uint32_t format = 0;
        std::string library;
        std::uint64_t size = 0;  // of a number, in bytes
        int digits = 0;          // binary, of its mantissa
        std::string text;

        void archive(detail::Archive archive) { archive(mark, format, library, size, digits, text); }
        std::string kind() const {
            std::ostringstream out;
            out << "format " << format << " of axistokes " << library << ", numbers of " << size << " bytes and "
                << digits << " digits";
            return out.str();
        }
    };

    StepJournal(const std::filesystem::path& path, Index every) : path_(path), every_(every) {
        detail::require(every >= 1, "steps from one flush of the journal to the next", every, "at least 1");
        in_.open(path, std::ios::binary);
        std::error_code error;
        const auto size = std::filesystem::file_size(path, error);
        left_ = error ? 0 : size;
        text_ = text_of(detail::read_block(in_, left_));
        const auto begin = in_.tellg();
        std::uint64_t torn = left_;
        while (detail::read_block(in_, torn)) {
        }
        if (torn > 0) {
            std::filesystem::resize_file(path, size - torn, error);
        }
        left_ -= torn;
        in_.clear();
        in_.seekg(begin);
        errno = 0;
        out_.open(path, std::ios::binary | std::ios::app);
        if (error || !out_) {
            throw OutputError(path, error ? error : std::error_code(errno, std::generic_category()));
        }
    }

    std::string text_of(std::optional<std::string> block) const {
        const auto refuse = [this](const std::string& why) { throw InvalidArgument(path_.string() + ": " + why); };
        Header found;
        try {
            if (block) {
                found.archive(detail::Archive(*block, detail::Archive::Way::read));
            }
        } catch (const InvalidArgument&) {
            found.mark.clear();
        }
        if (found.mark != mark) {
            refuse("is no journal of steps, or is damaged where it begins");
        }
        const Header own{mark, format, version, sizeof(S), std::numeric_limits<S>::digits, found.text};
        if (found.kind() != own.kind()) {
            refuse("is of " + found.kind() + "; this is " + own.kind());
        }
        return found.text;
    }

    std::filesystem::path path_;
    Index every_;
    std::string text_;
    std::ifstream in_;        // at the next step to repeat; closed after the last
    std::uint64_t left_ = 0;  // bytes of those
    std::ofstream out_;
    std::string pending_;
    Index steps_pending_ = 0;
};

}  // namespace axistokes
