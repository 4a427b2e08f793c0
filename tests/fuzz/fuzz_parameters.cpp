// SPDX-License-Identifier: MIT
// Fuzz target: shapes, profiles, walls, flows, kernels and step control, with any parameters.
#include "bytes.hpp"
#include <axistokes/accuracy.hpp>
#include <axistokes/discretization/adaptive_meridian.hpp>
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/flow/poiseuille.hpp>
#include <axistokes/flow/unbounded_poiseuille.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/geometry/tube_shapes.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/kernel/tube.hpp>
#include <axistokes/step_control.hpp>
#include <axistokes/wall/points_profile.hpp>
#include <axistokes/wall/profile.hpp>
#include <axistokes/wall/wall_mesh.hpp>

#include <vector>

namespace {

using namespace axistokes;
using fuzz::Bytes;
using fuzz::require_finite;

void check(const Meridian<double>& shape) {
    require_finite("r of a shape", shape.r.sum());
    require_finite("z of a shape", shape.z.sum());
    validate(shape);
}

/// Ordinary, or what no shape can have.
Index some_elements(Bytes& in) {
    return in.choice(6) == 0 ? -in.choice(3) : 4 + in.choice(60);
}

SpheroidKind kind(Bytes& in) {
    return in.flag() ? SpheroidKind::prolate : SpheroidKind::oblate;
}

NodeSpacing<double> spacing(Bytes& in) {
    return in.flag() ? NodeSpacing<double>{} : NodeSpacing<double>{in.between(0, 5), in.between(0, 1)};
}

void shapes(Bytes& in) {
    const Index elements = some_elements(in);
    switch (in.choice(5)) {
        case 0: {
            const double a = in.number();
            const double c = in.number();
            return check(spheroid<double>(a, c, elements, spacing(in)));
        }
        case 1:
            return check(sphere<double>(elements, in.number(), spacing(in)));
        case 2:
            return check(spheroid_of_aspect<double>(in.number(), elements, spacing(in)));
        case 3: {
            const SpheroidKind either = kind(in);
            return check(spheroid_of_excess_area<double>(in.number(), either, elements, spacing(in)));
        }
        default: {
            const SpheroidKind either = kind(in);
            const double excess_area = in.number();
            return check(shape_in_tube<double>(excess_area, in.number(), either, elements, spacing(in)));
        }
    }
}

template <class Profile>
void check_profile(const Profile& profile, Bytes& in) {
    const double x = in.between(-0.5, 1.5);
    const double z = std::clamp(profile.begin() * (1 - x) + profile.end() * x, profile.begin(), profile.end());
    require_finite("radius of a profile", profile.radius(z));
    require_finite("slope of a profile", profile.slope(z));
    WallMeshParams<double> params;
    params.tolerance = in.number();
    params.flow_rate = in.number();
    if (in.flag()) {
        params.length = in.number();
    }
    if (in.flag()) {
        params.panels = in.count(50);
    }
    if (in.flag()) {
        params.nodes_per_panel = in.count(20);
    }
    params.grading = std::array{WallGrading::automatic, WallGrading::uniform,
                                WallGrading::quadratic}[static_cast<std::size_t>(in.choice(3))];
    const WallMesh<Profile> wall(profile, params);
    require_finite("radius of a wall", wall.radius(in.between(-100, 100)));
}

void profiles(Bytes& in) {
    const double throat = in.number();
    const double wide = in.number();
    const double length = in.number();
    switch (in.choice(5)) {
        case 0:
            return check_profile(StraightTube<double>(throat), in);
        case 1:
            return check_profile(Pore<double>(throat, wide, length, in.number()), in);
        case 2:
            return check_profile(Constriction<double>(throat, wide, length), in);
        case 3: {
            const auto radius = [=](double) { return throat; };
            const auto slope = [=](double) { return 0 * throat; };
            return check_profile(CallableProfile(wide, length, radius, slope), in);
        }
        default: {
            std::vector<double> z;
            std::vector<double> r;
            for (int i = in.choice(10); i > 0; --i) {
                z.push_back(in.number());
                r.push_back(in.number());
            }
            if (in.flag()) {
                std::sort(z.begin(), z.end());
            }
            return check_profile(PointsProfile<double>(z, r), in);
        }
    }
}

void flows(Bytes& in) {
    const double strength = in.number();
    const double radius = in.number();
    const Point<double> x{in.between(0, 1), in.between(-0.5, 0.5)};
    switch (in.choice(3)) {
        case 0:
            return require_finite("Gravity::normal_load", Gravity<double>(strength).normal_load(x));
        case 1: {
            const Poiseuille<double> flow(strength, radius);
            const Point<double> inside{x.r * radius, x.z};
            require_finite("Poiseuille::velocity", flow.velocity(inside).z);
            require_finite("Poiseuille::mean_velocity", flow.mean_velocity());
            return require_finite("Poiseuille::velocity_scale", flow.velocity_scale());
        }
        default: {
            const UnboundedPoiseuille<double> flow(strength, x.z);
            return require_finite("UnboundedPoiseuille::velocity", flow.velocity({x.r / 2, x.z}).z);
        }
    }
}

void check_block(const char* what, const KernelBlock<double>& m) {
    for (const double entry : {m.rr, m.rz, m.zr, m.zz}) {
        require_finite(what, entry);
    }
}

/// What a kernel is made for: coordinates up to 1e10 radii of the tube and distinct points.
void kernels(Bytes& in) {
    const auto coordinate = [&] { return in.flag() ? in.between(0, 1) : std::pow(10.0, in.between(-30, 0)); };
    if (in.flag()) {
        const Point<double> target{coordinate() * std::pow(10.0, in.between(-10, 10)), coordinate()};
        Point<double> source{coordinate(), coordinate() * std::pow(10.0, in.between(-10, 10))};
        if (in.flag()) {
            source = {target.r * (1 + in.between(-1e-12, 1e-12)), target.z + in.between(-1e-9, 1e-9) * target.r};
        }
        if (source.r == target.r && source.z == target.z) {
            return;
        }
        const FreeSpaceKernel<double> kernel;
        check_block("FreeSpaceKernel::singular", kernel.singular(target, source));
        return check_block("FreeSpaceKernel::stress", kernel.stress(target, source, {0.6, 0.8}));
    }
    TubeKernel<double>::Params params;
    params.tolerance = in.flag() ? in.number() : std::pow(10.0, in.between(-13, -1));
    const double radius = in.flag() ? in.number() : std::pow(10.0, in.between(-3, 3));
    const TubeKernel<double> tube(radius, params);
    const double share = coordinate();
    const Point<double> target{in.flag() ? radius * share : radius * (1 - share), 0};
    const Point<double> source{radius * coordinate(), radius * coordinate() * std::pow(10.0, in.between(-3, 3))};
    check_block("TubeKernel::correction", tube.correction(target, source));
    check_block("TubeKernel::stress_correction", tube.stress_correction(target, source, {0.6, 0.8}));
    require_finite("TubeKernel::unit_flow", tube.unit_flow(target).z);
}

void policies(Bytes& in) {
    switch (in.choice(4)) {
        case 0: {
            const Accuracy<double> accuracy(in.number());
            return require_finite("Accuracy", accuracy.residual + accuracy.unresolved + accuracy.wall);
        }
        case 1: {
            LinearElements<double>::Params params;
            params.tolerance = in.number();
            return void(LinearElements<double>(params));
        }
        case 2: {
            SpectralMeridian<double>::Params params;
            params.tolerance = in.number();
            return void(SpectralMeridian<double>(params));
        }
        default: {
            AdaptiveMeridian<double>::Params params;
            params.tolerance = in.number();
            return void(AdaptiveMeridian<double>(params));
        }
    }
}

void steps(Bytes& in) {
    StepControlParams<double> params;
    const auto change = [&](double& value) {
        if (in.choice(4) == 0) {
            value = in.number();
        }
    };
    for (double* value :
         {&params.first_time_step, &params.largest_time_step, &params.smallest_time_step.emplace(1e-9),
          &params.step_tolerance, &params.largest_displacement, &params.largest_strain, &params.growth}) {
        change(*value);
    }
    if (in.flag()) {
        params.time_step = in.number();
    }
    StepControl<double> control(params);
    for (int i = 0; i < 20 && in.left() > 0; ++i) {
        require_finite("the time step", control.step());
        if (!(control.step() > 0)) {
            std::cerr << "the time step is " << control.step() << '\n';
            std::abort();
        }
        StepReport<double> report;
        report.dt = control.step() * in.between(0.1, 1);
        report.order = 1 + in.choice(6);
        report.displacement = std::abs(in.number());
        report.shear_rate = std::abs(in.number());
        report.reversed = in.flag();
        report.accelerating = in.flag();
        if (in.flag()) {
            report.error = std::abs(in.number());
        }
        const bool retried = in.flag();
        try {
            control.judge(report);
        } catch (const StepRejected& rejected) {
            if (!(rejected.factor() > 0 && rejected.factor() < 1)) {
                std::cerr << "a rejected step is multiplied by " << rejected.factor() << '\n';
                std::abort();
            }
            if (!control.shorten(report.dt * rejected.factor())) {
                return;
            }
            continue;
        }
        if (std::isfinite(report.displacement) && std::isfinite(report.shear_rate)) {
            control.accept(report, control.step(), retried);
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes in(data, size);
    const int what = in.choice(6);
    fuzz::attempt([&] {
        switch (what) {
            case 0:
                return shapes(in);
            case 1:
                return profiles(in);
            case 2:
                return flows(in);
            case 3:
                return kernels(in);
            case 4:
                return policies(in);
            default:
                return steps(in);
        }
    });
    return 0;
}
