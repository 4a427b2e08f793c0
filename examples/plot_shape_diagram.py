#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Map of bullets and parachutes from the table of shape_diagram, and some of the shapes.

shape_diagram --out out/diagram --shapes out/diagram/shapes
examples/plot_shape_diagram.py --table out/diagram/diagram.csv --shapes out/diagram/shapes --out shape_diagram.png
"""
import argparse
import csv
import pathlib
import sys

import numpy as np

from plot_run import plt

BULLET, PARACHUTE = "#1f5fa8", "#d08a00"
COLORS = {"bullet": BULLET, "parachute": PARACHUTE}


def read_states(path):
    """The table's states, numbers as such; cases without one are counted."""
    states, failed = [], 0
    with open(path, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if not row["branch"]:
                failed += 1
                continue
            for name, value in row.items():
                if name not in ("branch", "start", "failure"):
                    row[name] = float(value)
            states.append(row)
    return states, failed


def draw_map(axes, states):
    cases = {}
    for state in states:
        cases.setdefault((state["confinement"], state["reduced_volume"]), []).append(state)
    for (confinement, volume), found in cases.items():
        stable = [s for s in found if s["stable"]]
        branches = [s["branch"] for s in stable]
        if not branches:
            axes.plot(confinement, volume, "x", color="0.5")
        elif len(set(branches)) == 1:
            axes.plot(confinement, volume, "o", color=COLORS[branches[0]], ms=8,
                      mec="black" if len(branches) > 1 else "none")
        else:
            axes.plot(confinement, volume, "o", fillstyle="left", color=BULLET, markerfacecoloralt=PARACHUTE, ms=8,
                      mec="none")
    # Where the rear of the states that a prolate start leads to is flat.
    confinements = sorted({c for c, _ in cases})
    volumes = sorted({v for _, v in cases})
    rear = np.full((len(volumes), len(confinements)), np.nan)
    for (confinement, volume), found in cases.items():
        for state in found:
            if state["start"] == "prolate":
                rear[volumes.index(volume), confinements.index(confinement)] = state["rear_curvature"]
    if np.nanmin(rear) < 0 < np.nanmax(rear):
        axes.contour(confinements, volumes, rear, levels=[0], colors="black", linewidths=1.2)
    # Where the second state ends.
    second = np.array([[any(s["branch"] == "parachute" for s in cases.get((c, v), [])) for c in confinements]
                       for v in volumes], dtype=float)
    if 0 < second.mean() < 1:
        axes.contour(confinements, volumes, second, levels=[0.5], colors="black", linestyles="--", linewidths=1.2)
    axes.set_xlim(confinements[0] - 0.03, confinements[-1] + 0.03)
    axes.set_ylim(volumes[0] - 0.012, volumes[-1] + 0.012)
    axes.set_xlabel(r"confinement $R_0/R_c$")
    axes.set_ylabel("reduced volume")
    handles = [plt.Line2D([], [], ls="", marker="o", color=BULLET, label="bullet"),
               plt.Line2D([], [], ls="", marker="o", color=PARACHUTE, label="parachute"),
               plt.Line2D([], [], ls="", marker="o", fillstyle="left", color=BULLET, markerfacecoloralt=PARACHUTE,
                          mec="none", label="both stable"),
               plt.Line2D([], [], ls="", marker="o", color=BULLET, mec="black", label="two bullets"),
               plt.Line2D([], [], color="black", label="flat rear"),
               plt.Line2D([], [], color="black", ls="--", label="end of parachutes")]
    axes.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 1.14), ncol=3, fontsize=8, frameon=False)


def draw_shape(axes, states, directory, confinement, volume):
    """All states of the case nearest to the one wanted, in their tube, the flow to the right."""
    nearest = min(states, key=lambda s: abs(s["confinement"] - confinement) + abs(s["reduced_volume"] - volume))
    case = [s for s in states if all(s[k] == nearest[k] for k in ("confinement", "reduced_volume"))]
    for state in case:
        name = "shape_{:.12g}_{:.12g}_{:.12g}_{}.csv".format(state["confinement"], state["reduced_volume"],
                                                    state["capillary_number"], state["start"])
        r, z = np.loadtxt(directory / name, delimiter=",", skiprows=1).T
        axes.plot(np.concatenate([z, z[::-1]]), np.concatenate([r, -r[::-1]]), color=COLORS[state["branch"]], lw=1.3)
    radius = 1 / nearest["confinement"]
    for sign in (-1, 1):
        axes.axhline(sign * radius, color="0.4", lw=2)
    axes.set_title("L = {:g}, v = {:g}".format(nearest["confinement"], nearest["reduced_volume"]), fontsize=8)
    axes.set_xlim(-3, 2.6)
    axes.set_ylim(-2.2, 2.2)
    axes.set_aspect("equal")
    axes.axis("off")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--table", required=True, help="diagram.csv")
    parser.add_argument("--shapes", help="directory that shape_diagram --shapes wrote")
    parser.add_argument("--out", required=True, help="picture to write")
    arguments = parser.parse_args()
    states, failed = read_states(arguments.table)
    if not states:
        sys.exit("plot_shape_diagram: no states in " + arguments.table)
    figure = plt.figure(figsize=(10, 5), layout="constrained")
    left, right = figure.subfigures(1, 2, width_ratios=(1.1, 1))
    axes = left.subplots()
    draw_map(axes, states)
    axes.set_title("Ca = {:g}".format(states[0]["capillary_number"]) +
                   (", {} cases without a state".format(failed) if failed else ""), loc="left", fontsize=8)
    if arguments.shapes:
        panels = right.subplots(3, 3)
        for row, volume in zip(panels, (0.96, 0.8, 0.7)):
            for panel, confinement in zip(row, (0.3, 0.6, 0.9)):
                draw_shape(panel, states, pathlib.Path(arguments.shapes), confinement, volume)
    figure.savefig(arguments.out, dpi=110)


if __name__ == "__main__":
    main()
