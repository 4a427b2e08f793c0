#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws a vesicle's way through a channel: plot_passage.py DIR writes DIR/passage.png, a film strip with the history of
the pressure drop, of the velocity and of the film. With --gif also DIR/passage.gif, the frames as an animation.
"""
import argparse
import csv
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.animation
import matplotlib.pyplot as plt
import numpy as np

plt.rcParams.update({
    "font.size": 9, "axes.labelsize": 9, "mathtext.fontset": "dejavusans", "axes.spines.top": False,
    "axes.spines.right": False, "axes.grid": True, "grid.alpha": 0.25, "lines.linewidth": 1.5, "savefig.dpi": 110,
})
VESICLE = {"facecolor": "#fbe9d9", "edgecolor": "#b5541c", "lw": 1.6}


def read_table(path):
    """Columns of a CSV file with a header line, by name."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    values = np.array(rows[1:], dtype=float).reshape(len(rows) - 1, len(rows[0]))
    return {name: values[:, i] for i, name in enumerate(rows[0])}


def read_frames(path):
    """(time, z, r) of every frame, the closed cross-section, flow to the right."""
    table = read_table(path)
    frames = []
    for number in np.unique(table["frame"]):
        rows = table["frame"] == number
        z, r = table["z"][rows], table["r"][rows]
        frames.append((table["time"][rows][0], np.append(z, z[::-1]), np.append(r, -r[::-1])))
    return frames


def draw_channel(axes, wall, limits):
    height = 1.08 * np.max(wall["r"])
    for side in (-1, 1):
        axes.fill_between(wall["z"], side * wall["r"], side * height, color="0.75", lw=0)
        axes.plot(wall["z"], side * wall["r"], color="0.3", lw=1)
    axes.axhline(0, color="0.5", lw=0.5, ls=(0, (8, 4)))
    axes.set(xlim=limits, ylim=(-height, height), aspect="equal", yticks=[])
    axes.grid(False)
    axes.spines[:].set_visible(False)
    axes.tick_params(bottom=False, labelbottom=False)


def limits_of(frames):
    return min(np.min(z) for _, z, _ in frames) - 0.3, max(np.max(z) for _, z, _ in frames) + 0.3


def draw_history(axes, history):
    position = history["position"]
    for axis, name, label, color in (
            (axes[0], "pressure_drop", "added pressure drop\n" + r"($\kappa/R_0^3$)", "#1f5fa8"),
            (axes[1], "velocity", "velocity\n" + r"($\kappa/(\eta R_0^2)$)", "#2b7a4b"),
            (axes[2], "film_thickness_min", "smallest film\n" + r"($R_0$)", "#b5541c")):
        axis.plot(position, history[name], color=color)
        axis.set_ylabel(label)
        axis.set_xlabel(r"position of the centroid ($R_0$)")
    axes[2].set_yscale("log")


def title_of(summary):
    parameters = summary["parameters"]
    title = (rf"{parameters['profile']}    throat {parameters['throat']:.3g} $R_0$    "
             rf"$\Delta$ = {parameters['excess_area']:.3g}    $Q$ = {parameters['flow_rate']:.4g}")
    if "transit_time" in summary:
        title += rf"    transit time {summary['transit_time']:.4g} $\eta R_0^3/\kappa$"
    return title


def film_strip(directory, summary, wall, frames, history):
    limits = limits_of(frames)
    strip = 10.0 * 2.16 * np.max(wall["r"]) / (limits[1] - limits[0])
    ratios = [strip] * len(frames) + [2.2]
    figure = plt.figure(figsize=(10, sum(ratios) + 1.2), layout="constrained")
    grid = figure.add_gridspec(len(ratios), 3, height_ratios=ratios)
    for i, (time, z, r) in enumerate(frames):
        axes = figure.add_subplot(grid[i, :])
        draw_channel(axes, wall, limits)
        axes.fill(z, r, zorder=3, **VESICLE)
        axes.text(0.005, 0.9, f"t = {time:.3g}", transform=axes.transAxes, va="top",
                  bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.5})
    draw_history([figure.add_subplot(grid[len(frames), k]) for k in range(3)], history)
    figure.suptitle(title_of(summary), fontsize=11)
    path = directory / "passage.png"
    figure.savefig(path)
    plt.close(figure)
    return path


def animate(directory, summary, wall, frames):
    figure, axes = plt.subplots(figsize=(8, 2.4), layout="constrained")
    draw_channel(axes, wall, limits_of(frames))
    vesicle, = axes.fill(frames[0][1], frames[0][2], zorder=3, **VESICLE)

    def show(frame):
        time, z, r = frame
        vesicle.set_xy(np.column_stack([z, r]))
        axes.set_title(f"t = {time:.3g}", fontsize=9)
        return [vesicle]

    path = directory / "passage.gif"
    matplotlib.animation.FuncAnimation(figure, show, frames).save(path, writer="pillow", fps=10)
    plt.close(figure)
    return path


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path, help="output directory of vesicle_through_constriction")
    parser.add_argument("--gif", action="store_true", help="also write an animation")
    arguments = parser.parse_args()
    directory = arguments.directory
    try:
        with open(directory / "summary.json") as file:
            summary = json.load(file)
        wall = read_table(directory / "wall.csv")
        frames = read_frames(directory / "frames.csv")
        print(film_strip(directory, summary, wall, frames, read_table(directory / "history.csv")))
        if arguments.gif:
            print(animate(directory, summary, wall, frames))
    except (OSError, KeyError, ValueError) as error:
        print(f"plot_passage.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
