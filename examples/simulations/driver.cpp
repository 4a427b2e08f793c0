// SPDX-License-Identifier: MIT
#include "../support/driver.hpp"

#include <utility>

namespace examples {

Driver::Driver(std::function<Simulation(axistokes::Index)> make, const Params& params,
               std::function<bool(const Simulation&)> observer)
    : impl_(std::make_unique<Impl>(std::move(make), params, std::move(observer))) {}

Driver::~Driver() = default;

Simulation& Driver::simulation() {
    return impl_->simulator();
}

const Driver::Result& Driver::result() const {
    return impl_->result();
}

const Driver::Result& Driver::run() {
    return impl_->run();
}

}  // namespace examples
