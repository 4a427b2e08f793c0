// SPDX-License-Identifier: MIT
// The library's Driver of these simulations, compiled once.
#pragma once

#include "simulation.hpp"
#include <axistokes/accuracy/driver.hpp>

#include <functional>
#include <memory>

namespace examples {

class Driver {
  public:
    using Impl = axistokes::Driver<Simulation, Newton>;
    using Params = axistokes::DriverParams<double>;
    using Result = axistokes::DriverResult<Simulation>;

    Driver(std::function<Simulation(axistokes::Index)> make, const Params& params,
           std::function<bool(const Simulation&)> observer);
    Driver(const Driver&) = delete;
    Driver& operator=(const Driver&) = delete;
    ~Driver();

    Simulation& simulation();
    const Result& result() const;
    const Result& run();

  private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace examples
