// SPDX-License-Identifier: MIT
// The mesh with the fewest nodes that keeps an error below a bound.
#pragma once

#include <axistokes/wall/channel_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace examples {

inline const char* name_of(axistokes::WallGrading grading) {
    return grading == axistokes::WallGrading::uniform     ? "uniform"
           : grading == axistokes::WallGrading::quadratic ? "quadratic"
                                                          : "adaptive";
}

struct CheapestWall {
    axistokes::WallMeshParams<double> params;
    axistokes::Index panels = 0;    // on the wall, without the ends
    axistokes::Index nodes = 1000;  // more are not tried
    double error = std::numeric_limits<double>::infinity();
};

/// Searches all combinations of gradings, nodes a panel, lengths (beyond the particle, in R0) and numbers of panels for
/// the mesh of fewest nodes, those on the ends included, whose `error(params)` is below the accuracy; that of the next
/// finer mesh must be, too, lest a change of sign passes for accuracy. Where the error no longer depends on the number
/// of panels the wall is too short. Put lengths and orders first that need few nodes: they cut the search short.
template <class Error>
CheapestWall cheapest_wall(const axistokes::StraightTube<double>& tube, const axistokes::Meridian<double>& particle,
                           double accuracy, const std::vector<axistokes::WallGrading>& gradings,
                           const std::vector<axistokes::Index>& orders, const std::vector<double>& lengths,
                           const Error& error) {
    using axistokes::Index;
    CheapestWall best;
    for (const auto grading : gradings) {
        for (const Index order : orders) {
            for (const double length : lengths) {
                axistokes::WallMeshParams<double> params;
                params.tolerance = accuracy;
                params.grading = grading;
                params.nodes_per_panel = order;
                params.length = length;
                double before = std::numeric_limits<double>::infinity();
                Index nodes_before = 0;
                Index panels_before = 0;
                for (Index panels = 2;; panels += std::max<Index>(1, panels / 16)) {
                    params.panels = panels;
                    const Index nodes =
                        axistokes::ChannelMesh<axistokes::StraightTube<double>>(tube, params, particle).curve().size();
                    if ((before < accuracy ? nodes_before : nodes) >= best.nodes) {
                        break;
                    }
                    const double now = error(params);
                    if (before < accuracy && now < accuracy) {
                        best = {params, panels_before, nodes_before, before};
                        best.params.panels = panels_before;
                        break;
                    }
                    if (std::abs(now - before) < 1e-2 * before) {
                        break;
                    }
                    before = now;
                    nodes_before = nodes;
                    panels_before = panels;
                }
            }
        }
    }
    return best;
}

}  // namespace examples
