// SPDX-License-Identifier: MIT
// What a run leaves behind so that it can be gone on with after whatever ended it.
#pragma once

#include <axistokes/io/step_journal.hpp>

#include <memory>
#include <string>

namespace examples {

using Journal = axistokes::StepJournal<double>;

struct Checkpoints {
    /// Of a run's directory.
    static constexpr const char* file = "run.journal";

    axistokes::Index every = 1;  // steps from one flush to the next
    bool resumed = false;
    std::string command;  // the program and its arguments, each ended by '\0'

    /// The journal in the directory of the results: the one that is there if the run is gone on with, or a new one.
    /// Null without a directory. Throws OutputError unless the directory can be written and has some space.
    std::shared_ptr<Journal> journal(const std::string& directory) const;
};

}  // namespace examples
