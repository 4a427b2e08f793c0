// SPDX-License-Identifier: MIT
// Tables that depend on a few numbers only, shared by all who need them.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>

namespace axistokes::detail {

/// T(arguments), computed at the first call and shared by all.
template <class T, class... Arguments>
std::shared_ptr<const T> computed_once(Arguments... arguments) {
    static std::mutex mutex;
    static std::map<std::tuple<Arguments...>, std::shared_ptr<const T>> known;
    const std::tuple<Arguments...> key(arguments...);
    {
        const std::lock_guard<std::mutex> lock(mutex);
        if (const auto found = known.find(key); found != known.end()) {
            return found->second;
        }
    }
    auto value = std::make_shared<const T>(arguments...);
    const std::lock_guard<std::mutex> lock(mutex);
    return known.emplace(key, std::move(value)).first->second;
}

}  // namespace axistokes::detail
