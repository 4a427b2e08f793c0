// SPDX-License-Identifier: MIT
// The mesh with the fewest nodes that keeps an error below a bound.
#pragma once

#include <axistokes/wall/channel_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace examples {

inline const char* name_of(axistokes::WallGrading grading) {
    return grading == axistokes::WallGrading::uniform     ? "uniform"
           : grading == axistokes::WallGrading::quadratic ? "quadratic"
                                                          : "adaptive";
}

struct CheapestWall {
    axistokes::WallMeshParams<double> params;
    axistokes::Index nodes = 1000;  // those on the ends included; more are not tried
    double error = std::numeric_limits<double>::infinity();
};

/// Increases the number of panels until `error(params)` is below the accuracy, also with the next finer mesh, lest a
/// change of sign passes for accuracy. Gives up where twice the panels leave the error as it was (the wall is too
/// short), and beyond the nodes of `best`, which it replaces otherwise.
template <class Error>
void fewest_panels(const axistokes::StraightTube<double>& tube, const axistokes::Meridian<double>& particle,
                   double accuracy, axistokes::WallMeshParams<double> params, const Error& error, CheapestWall& best) {
    using Mesh = axistokes::ChannelMesh<axistokes::StraightTube<double>>;
    std::vector<CheapestWall> tried;
    for (axistokes::Index panels = 2;; panels += std::max<axistokes::Index>(1, panels / 16)) {
        params.panels = panels;
        const bool confirming = !tried.empty() && tried.back().error < accuracy;
        const axistokes::Index nodes = Mesh(tube, params, particle).curve().size();
        if ((confirming ? tried.back().nodes : nodes) >= best.nodes) {
            return;
        }
        const double now = error(params);
        if (confirming && now < accuracy) {
            best = tried.back();
            return;
        }
        const auto half = std::find_if(tried.rbegin(), tried.rend(),
                                       [&](const CheapestWall& wall) { return 2 * *wall.params.panels <= panels; });
        if (half != tried.rend() && std::abs(now - half->error) < 1e-2 * half->error) {
            return;
        }
        tried.push_back({params, nodes, now});
    }
}

/// The mesh of fewest nodes over all combinations of gradings, nodes a panel and lengths (beyond the particle, in R0).
/// Put those first that need few nodes: they cut the search short.
template <class Error>
CheapestWall cheapest_wall(const axistokes::StraightTube<double>& tube, const axistokes::Meridian<double>& particle,
                           double accuracy, const std::vector<axistokes::WallGrading>& gradings,
                           const std::vector<axistokes::Index>& orders, const std::vector<double>& lengths,
                           const Error& error) {
    CheapestWall best;
    for (const auto grading : gradings) {
        for (const axistokes::Index order : orders) {
            for (const double length : lengths) {
                axistokes::WallMeshParams<double> params;
                params.tolerance = accuracy;
                params.grading = grading;
                params.nodes_per_panel = order;
                params.length = length;
                fewest_panels(tube, particle, accuracy, params, error, best);
            }
        }
    }
    return best;
}

}  // namespace examples
