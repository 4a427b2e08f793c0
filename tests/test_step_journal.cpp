// SPDX-License-Identifier: MIT
// Runs that go on from recorded steps are those that were never stopped, to the last bit; and what is no journal, or
// not the simulation's, is refused.
#include "../examples/write_your_own/capsule.hpp"
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/axistokes.hpp>

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace axistokes;
using Journal = StepJournal<double>;
namespace fs = std::filesystem;

/// A file of a name of its own, gone afterwards.
class Scratch {
  public:
    Scratch() {
        static int count = 0;
        path_ = fs::temp_directory_path() /
                ("axistokes_" + std::to_string(getpid()) + "_" + std::to_string(count++) + ".journal");
    }
    explicit Scratch(const std::string& bytes) : Scratch() { std::ofstream(path_, std::ios::binary) << bytes; }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() {
        std::error_code ignored;
        fs::remove(path_, ignored);
    }
    operator const fs::path&() const { return path_; }
    std::string bytes() const {
        std::ifstream in(path_, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

  private:
    fs::path path_;
};

bool same(const Vector<double>& a, const Vector<double>& b) {
    return a.size() == b.size() &&
           std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

bool same(const Meridian<double>& a, const Meridian<double>& b) {
    return same(a.r, b.r) && same(a.z, b.z);
}

bool same(const std::vector<Configuration<double>>& a, const std::vector<Configuration<double>>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
        return same(x.shape, y.shape) && x.position == y.position && same(x.tension, y.tension) &&
               same(x.reference, y.reference);
    });
}

bool same(const std::vector<StepRecord<double>>& a, const std::vector<StepRecord<double>>& b) {
    const auto left = history_columns(a);
    const auto right = history_columns(b);
    return std::equal(left.begin(), left.end(), right.begin(), right.end(),
                      [](const auto& x, const auto& y) { return same(x.values, y.values); }) &&
           std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const auto& x, const auto& y) { return x.step_error == y.step_error; });
}

/// States, histories and what follows from them.
template <class Simulation>
void require_same(Simulation& a, Simulation& b) {
    REQUIRE(a.time() == b.time());
    REQUIRE(same(a.state(), b.state()));
    for (std::size_t body = 0; body < a.bodies(); ++body) {
        REQUIRE(same(a.history(body), b.history(body)));
        REQUIRE(same(a.instant(body).solution.force, b.instant(body).solution.force));
    }
    REQUIRE(same(a.scene().memory(), b.scene().memory()));
}

template <class Simulation>
void advance(Simulation& simulation, int steps) {
    for (int i = 0; i < steps; ++i) {
        simulation.step();
    }
}

/// A run stopped after each number of steps from `first_stop` on and gone on with.
template <class Make>
void check_resumed(const Make& make, int steps, int first_stop = 0) {
    auto whole = make();
    advance(whole, steps);
    for (int stop = first_stop; stop <= steps; ++stop) {
        INFO("stopped after " << stop);
        const Scratch file;
        auto first = make();
        first.record_in(Journal::create(file));
        advance(first, stop);
        first.record_in(nullptr);
        auto second = make();
        second.record_in(Journal::resume(file));
        advance(second, steps);
        require_same(whole, second);
    }
}

Meridian<double> prolate(Index elements) {
    return spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, elements);
}

template <class Discretization>
Meridian<double> prolate_on(const Discretization& discretization, Index elements) {
    return nodes_of(discretization, prolate, elements);
}

template <class Discretization>
auto settling(const Discretization& discretization, int order, Index elements, SimulationParams<double> params = {}) {
    return Simulator(
        Scene(FreeSpaceKernel<double>(), discretization, Vesicle<double>(), Gravity<double>(47), DenseLU<double>()),
        ExtrapolatedEulerOfOrder(order), prolate_on(discretization, elements), params);
}

auto linear() {
    return settling(LinearElements<double>(), 1, 12);
}

/// Semi-implicit Euler steps that are counted.
class Counting {
  public:
    static constexpr int order = 1;
    explicit Counting(int& count) : count_(&count) {}

    template <class SceneType, class S>
    auto step(SceneType& scene, const typename SceneType::Moment& start, const S& dt) const {
        ++*count_;
        return SemiImplicitEuler().step(scene, start, dt);
    }

  private:
    int* count_;
};

auto counting(int& count, const SimulationParams<double>& params = {}) {
    return Simulator(Scene(FreeSpaceKernel<double>(), LinearElements<double>(), Vesicle<double>(), Gravity<double>(200),
                           DenseLU<double>()),
                     Counting(count), prolate(16), params);
}

/// A journal of `steps` steps of linear(), and how many bytes it had after each.
std::vector<std::size_t> record_linear(const Scratch& file, int steps) {
    auto simulation = linear();
    simulation.record_in(Journal::create(file, "linear"));
    std::vector<std::size_t> sizes{fs::file_size(file)};
    for (int i = 0; i < steps; ++i) {
        simulation.step();
        sizes.push_back(fs::file_size(file));
    }
    return sizes;
}

int steps_in(Journal& journal) {
    int count = 0;
    while (journal.next()) {
        ++count;
    }
    return count;
}

}  // namespace

TEST_CASE("P1 elements and automatic steps go on as if nothing had happened") {
    check_resumed(linear, 5);
}

TEST_CASE("Steps that go back, and halve the next one, do so too") {
    constexpr int steps = 82;
    constexpr int before = 65;
    auto whole = linear();
    advance(whole, steps);
    bool halved = false;
    for (std::size_t i = before + 1; i < steps; ++i) {
        halved = halved || whole.history()[i].dt == whole.history()[i - 1].dt / 2;
    }
    REQUIRE(halved);
    check_resumed(linear, steps, before);
}

TEST_CASE("Rejected steps, and steps that land on given times, do so too") {
    SimulationParams<double> params;
    params.first_time_step = 0.5;
    params.landing_times = {0.002, 0.3};
    const auto make = [&] { return settling(LinearElements<double>(), 3, 12, params); };
    auto once = make();
    advance(once, 2);
    REQUIRE(once.history()[0].time == 0.002);
    REQUIRE(once.history()[1].rejected > 0);
    check_resumed(make, 5);
}

TEST_CASE("Series in a tube, of third order, do so too") {
    const auto make = [] {
        const TubeKernel<double> tube(0.9);
        const SpectralMeridian<double> series;
        const auto shape = [&](Index n) { return shape_in_tube(1.59, tube, SpheroidKind::prolate, n); };
        return Simulator(Scene(tube, series, Vesicle<double>(), Poiseuille<double>(100, tube), DenseLU<double>()),
                         ThirdOrder(), nodes_of(series, shape, 16));
    };
    check_resumed(make, 3);
}

TEST_CASE("Piecewise polynomials, of the order that a tolerance takes, do so too") {
    SimulationParams<double> params;
    params.step_tolerance = 1e-6;
    const auto make = [&] {
        return settling(AdaptiveMeridian<double>(), ExtrapolatedEulerOfOrder::for_tolerance(1e-6).order, 24, params);
    };
    check_resumed(make, 3);
}

TEST_CASE("Two vesicles do so too") {
    const auto make = [] {
        const SpectralMeridian<double> series;
        const auto shape = prolate_on(series, 16);
        return Simulator(
            Scene(FreeSpaceKernel<double>(), series, Vesicle<double>(), Gravity<double>(10), DenseLU<double>()),
            ThirdOrder(), std::vector<Meridian<double>>{shape, detail::shifted(shape, 3.0)});
    };
    check_resumed(make, 3);
}

TEST_CASE("Spheres of laws chosen at run time do so too") {
    const auto make = [] {
        using Either = OneOf<Vesicle<double>, RigidBody<double>>;
        const LinearElements<double> elements;
        const std::vector<Either> laws{Either(RigidBody<double>()), Either(Vesicle<double>())};
        const std::vector<Meridian<double>> shapes{sphere<double>(12), detail::shifted(prolate(12), 3.0)};
        return Simulator(Scene(FreeSpaceKernel<double>(), elements, laws, Gravity<double>(10), DenseLU<double>()),
                         SecondOrder(), shapes);
    };
    check_resumed(make, 3);
}

TEST_CASE("A law that remembers where its material was does so too") {
    const auto make = [] {
        return Simulator(Scene(FreeSpaceKernel<double>(), LinearElements<double>(),
                               write_your_own::Capsule<double>(1, 0.5), Gravity<double>(2), DenseLU<double>()),
                         SemiImplicitEuler(), prolate(16));
    };
    check_resumed(make, 4);
}

TEST_CASE("A meshed wall has the mesh that it would have") {
    SimulationParams<double> params;
    params.largest_displacement = 0.1;
    params.growth = 2;
    const auto make = [&] {
        WallMeshParams<double> wall;
        wall.flow_rate = 10;
        wall.tolerance = 1e-2;
        const Constriction<double> channel(0.8, 1.4, 2.5);
        const auto shape = detail::shifted(spheroid_of_excess_area<double>(2.0, SpheroidKind::prolate, 24), -4.5);
        return Simulator(Scene(FreeSpaceKernel<double>(), LinearElements<double>(), Vesicle<double>(),
                               Quiescent<double>(), DenseLU<double>(), WallMesh(channel, wall)),
                         SemiImplicitEuler(), shape, params);
    };
    constexpr int steps = 24;
    auto whole = make();
    advance(whole, steps);
    REQUIRE(whole.scene().wall().meshes() > 2);
    for (const int stop : {1, 7, 11, 16, 23, 24}) {
        for (const bool asked : {false, true}) {
            INFO("stopped after " << stop << ", velocities asked for on the way: " << asked);
            const Scratch file;
            auto first = make();
            first.record_in(Journal::create(file));
            advance(first, stop);
            auto second = make();
            second.record_in(Journal::resume(file));
            for (int i = 0; i < steps; ++i) {
                second.step();
                if (asked) {
                    second.moment();
                }
            }
            require_same(whole, second);
        }
    }
}

TEST_CASE("Recorded steps are not computed, and simulators that take turns share them") {
    const Scratch file;
    int computed = 0;
    {
        const auto journal = Journal::create(file);
        for (const int steps : {3, 2}) {
            auto simulation = counting(computed);
            simulation.record_in(journal);
            advance(simulation, steps);
        }
    }
    REQUIRE(computed == 5);
    int again = 0;
    const auto journal = Journal::resume(file);
    auto one = counting(again);
    one.record_in(journal);
    advance(one, 3);
    auto other = counting(again);
    other.record_in(journal);
    advance(other, 2);
    CHECK(again == 0);
    other.step();
    CHECK(again > 0);
    auto whole = counting(again);
    advance(whole, 3);
    require_same(whole, other);
}

TEST_CASE("A failure is recorded, with what it leaves behind") {
    SimulationParams<double> params;
    params.first_time_step = 1;
    params.smallest_time_step = 0.3;
    const Scratch file;
    int computed = 0;
    auto first = counting(computed, params);
    first.record_in(Journal::create(file));
    const std::string cause = test::failure([&] { first.step(); });
    CHECK(cause.find("step 1 at time 0: the time step fell below") == 0);
    first.record_in(nullptr);
    const int attempts = std::exchange(computed, 0);
    REQUIRE(attempts > 1);
    auto second = counting(computed, params);
    second.record_in(Journal::resume(file));
    CHECK(test::failure([&] { second.step(); }) == cause);
    CHECK(computed == 0);
    // Both plan the same step, one too short, now.
    CHECK(test::failure([&] { second.step(); }) == test::failure([&] { first.step(); }));
    CHECK(computed == 2);
}

TEST_CASE("Steps are flushed as often as asked for, and at the end") {
    const Scratch file;
    auto simulation = linear();
    const auto journal = Journal::create(file, "text", 3);
    simulation.record_in(journal);
    const auto begin = fs::file_size(file);
    advance(simulation, 2);
    CHECK(fs::file_size(file) == begin);
    simulation.step();
    const auto three = fs::file_size(file);
    CHECK(three > begin);
    simulation.step();
    CHECK(fs::file_size(file) == three);
    journal->flush();
    CHECK(fs::file_size(file) > three);
    CHECK(Journal::resume(file)->text() == "text");
    CHECK(steps_in(*Journal::resume(file)) == 4);
    journal->remove();
    CHECK_FALSE(fs::exists(file));
    CHECK(test::mentions(test::refusal([&] { Journal::create(file, "", 0); }), "steps from one flush", "0",
                         "at least 1"));
}

TEST_CASE("A step cut off at any byte is dropped, and the run goes on before it") {
    const Scratch file;
    const auto sizes = record_linear(file, 3);
    const std::string bytes = file.bytes();
    for (std::size_t size = sizes[2]; size < sizes[3]; ++size) {
        const Scratch torn(bytes.substr(0, size));
        const auto journal = Journal::resume(torn);
        REQUIRE(fs::file_size(torn) == sizes[2]);
        REQUIRE(steps_in(*journal) == 2);
    }
    auto whole = linear();
    advance(whole, 4);
    for (const std::size_t size : {sizes[2] + 1, sizes[3] - 1, sizes[3]}) {
        const Scratch torn(bytes.substr(0, size));
        auto simulation = linear();
        simulation.record_in(Journal::resume(torn));
        advance(simulation, 4);
        require_same(whole, simulation);
        CHECK(steps_in(*Journal::resume(torn)) == 4);
    }
}

TEST_CASE("From a byte that has changed on, steps are dropped") {
    const Scratch file;
    const auto sizes = record_linear(file, 3);
    const std::string bytes = file.bytes();
    for (std::size_t at = sizes[1]; at < sizes[3]; ++at) {
        std::string flipped = bytes;
        flipped[at] = static_cast<char>(flipped[at] ^ 0x10);
        const Scratch damaged(flipped);
        REQUIRE(steps_in(*Journal::resume(damaged)) == (at < sizes[2] ? 1 : 2));
    }
    for (std::size_t at = 0; at < sizes[0]; ++at) {
        std::string flipped = bytes;
        flipped[at] = static_cast<char>(flipped[at] ^ 0x10);
        const Scratch damaged(flipped);
        REQUIRE(test::refusal([&] { Journal::resume(damaged); }).find("is no journal of steps") != std::string::npos);
        REQUIRE(damaged.bytes() == flipped);
    }
}

TEST_CASE("What is no journal, or one of another kind, is refused and left as it is") {
    const auto refused = [](const std::string& bytes) {
        const Scratch file(bytes);
        const std::string message = test::refusal([&] { Journal::resume(file); });
        CHECK(file.bytes() == bytes);
        return message;
    };
    for (const std::string& bytes : {std::string(), std::string("step,time\n1,0.1\n"), std::string(500, '\0')}) {
        CHECK(refused(bytes).find("is no journal of steps") != std::string::npos);
    }
    const auto of = [](std::uint32_t format, std::string library, std::uint64_t size, int digits) {
        std::string bytes;
        std::string mark = "axistokes journal of steps";
        std::string text;
        detail::Archive(bytes, detail::Archive::Way::write)(mark, format, library, size, digits, text);
        return detail::block_of(bytes);
    };
    const Scratch own(of(1, AXISTOKES_VERSION, 8, 53));
    CHECK(steps_in(*Journal::resume(own)) == 0);
    CHECK(refused(of(2, AXISTOKES_VERSION, 8, 53)).find("is of format 2 of axistokes") != std::string::npos);
    CHECK(refused(of(1, "0.0.9", 8, 53)).find("of axistokes 0.0.9, numbers") != std::string::npos);
    CHECK(refused(of(1, AXISTOKES_VERSION, 4, 24)).find("numbers of 4 bytes and 24 digits; this is") !=
          std::string::npos);
    const Scratch single;
    StepJournal<float>::create(single);
    CHECK(test::refusal([&] { Journal::resume(single); }).find("numbers of 4 bytes") != std::string::npos);
    const Scratch missing;
    CHECK(test::refusal([&] { Journal::resume(missing); }).find("is no journal of steps") != std::string::npos);
}

TEST_CASE("Steps of another simulation are refused") {
    const Scratch file;
    record_linear(file, 2);
    auto finer = settling(LinearElements<double>(), 1, 16);
    finer.record_in(Journal::resume(file));
    CHECK(test::mentions(test::refusal([&] { finer.step(); }), "recorded step", "1", "step 1 of this simulation"));
    auto later = linear();
    later.step();
    later.record_in(Journal::resume(file));
    CHECK(test::mentions(test::refusal([&] { later.step(); }), "recorded step", "1", "step 2 of this simulation"));
}

TEST_CASE("A full disk is reported, the state stays good, and the run goes on when there is space again") {
    auto whole = linear();
    advance(whole, 4);
    const Scratch file;
    {
        auto simulation = linear();
        const auto journal = Journal::create(file);
        simulation.record_in(journal);
        advance(simulation, 2);
        // No file may grow beyond 100 bytes more.
        rlimit before{};
        getrlimit(RLIMIT_FSIZE, &before);
        const auto handler = std::signal(SIGXFSZ, SIG_IGN);
        rlimit limit = before;
        limit.rlim_cur = fs::file_size(file) + 100;
        setrlimit(RLIMIT_FSIZE, &limit);
        std::string cause;
        try {
            simulation.step();
        } catch (const OutputError& error) {
            cause = error.what();
        }
        setrlimit(RLIMIT_FSIZE, &before);
        std::signal(SIGXFSZ, handler);
        CHECK(cause.find("cannot be written: File too large") != std::string::npos);
        CHECK(simulation.history().size() == 3);
    }
    auto simulation = linear();
    simulation.record_in(Journal::resume(file));
    advance(simulation, 4);
    require_same(whole, simulation);
}

namespace {

using Index = axistokes::Index;

/// What a driver came to.
template <class DriverType>
void require_same_result(const DriverType& a, const DriverType& b) {
    REQUIRE(same(a.result().bodies, b.result().bodies));
    REQUIRE(a.result().velocity == b.result().velocity);
    REQUIRE(a.result().residual == b.result().residual);
    REQUIRE(a.result().error_estimate == b.result().error_estimate);
    REQUIRE(a.result().newton_evaluations == b.result().newton_evaluations);
    REQUIRE(a.result().growth_rate == b.result().growth_rate);
    REQUIRE(a.result().interrupted == b.result().interrupted);
    for (std::size_t body = 0; body < a.simulator().bodies(); ++body) {
        REQUIRE(same(a.simulator().history(body), b.simulator().history(body)));
    }
}

/// A driver's run, gone on with where it was killed (a part of its journal) or stopped by its observer.
template <class Make>
void check_driver(const Make& make, const DriverParams<double>& params, const std::vector<double>& parts) {
    using Simulation = decltype(make(Index(16)));
    using Run = Driver<Simulation>;
    const auto recorded = [&](const std::shared_ptr<Journal>& journal) {
        return [&make, journal](Index elements) {
            Simulation simulation = make(elements);
            simulation.record_in(journal);
            return simulation;
        };
    };
    Run whole(make, params);
    whole.run();
    const Scratch file;
    int steps = 0;
    {
        Run run(recorded(Journal::create(file)), params, [&](const Simulation&) { return ++steps > 0; });
        run.run();
        require_same_result(whole, run);
    }
    const std::string bytes = file.bytes();
    for (const double part : parts) {
        INFO("part " << part << " of " << steps << " steps");
        const Scratch killed(bytes.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes.size()))));
        Run run(recorded(Journal::resume(killed)), params);
        run.run();
        require_same_result(whole, run);

        const Scratch stopped;
        {
            int left = static_cast<int>(part * steps);
            Run first(recorded(Journal::create(stopped)), params, [&](const Simulation&) { return --left > 0; });
            first.run();
            REQUIRE(first.result().interrupted);
            // No step after the one at which it was stopped.
            REQUIRE(left <= 0);
            REQUIRE(left >= -1);
        }
        Run second(recorded(Journal::resume(stopped)), params);
        second.run();
        require_same_result(whole, second);
    }
}

}  // namespace

TEST_CASE("Drivers: refinement, and the last digits by Newton's method") {
    DriverParams<double> params;
    params.eps = 1e-4;
    params.unresolved = 2e-4;
    params.first_elements = 12;
    check_driver([](Index n) { return settling(SpectralMeridian<double>(), 1, n); }, params, {0.1, 0.4, 0.7, 0.95});
}

TEST_CASE("Drivers: a shape that its modes cannot carry, at the first step and later") {
    DriverParams<double> params;
    params.eps = 1e-2;
    params.unresolved = 2e-2;
    params.first_elements = 12;
    params.way = WayToStationary::march;
    const auto make = [](Index n) {
        const SpectralMeridian<double> series;
        const auto shape = [](Index k) { return spheroid_of_excess_area<double>(5.1, SpheroidKind::prolate, k); };
        SimulationParams<double> simulation;
        simulation.most_steps = 60;
        return Simulator(
            Scene(FreeSpaceKernel<double>(), series, Vesicle<double>(), Gravity<double>(1), DenseLU<double>()),
            ExtrapolatedEulerOfOrder(1), nodes_of(series, shape, n), simulation);
    };
    check_driver(make, params, {0.3, 0.8});
}

TEST_CASE("Drivers: more and more P1 elements, from the start again") {
    DriverParams<double> params;
    params.eps = 2e-2;
    params.transient = true;
    params.first_elements = 12;
    SimulationParams<double> simulation;
    simulation.longest_time = 0.01;
    check_driver([&](Index n) { return settling(LinearElements<double>(), 1, n, simulation); }, params,
                 {0.2, 0.6, 0.9});
}

TEST_CASE("Drivers: a coarser run to compare with") {
    DriverParams<double> params;
    params.elements = 16;
    params.way = WayToStationary::march;
    SimulationParams<double> simulation;
    simulation.most_steps = 20;
    simulation.tolerance = 1e-2;
    check_driver([&](Index n) { return settling(LinearElements<double>(), 1, n, simulation); }, params, {0.3, 0.75});
}

TEST_CASE("The library knows its version") {
    CHECK(std::string(version) == AXISTOKES_VERSION);
}
