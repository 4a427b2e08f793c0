#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the results of an example: plot_run.py DIR writes DIR/summary.png (shape, history, force profiles).

plot_run.py --compare DIR DIR ... [--out FILE] overlays the final shapes.
"""
import argparse
import csv
import json
import pathlib
import sys
import xml.etree.ElementTree as ElementTree

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

FORCE = r"$\kappa/R_0^3$"
VELOCITY = r"$\kappa/(\eta R_0^2)$"
TIME = r"$\eta R_0^3/\kappa$"
plt.rcParams.update({
    "font.size": 9, "axes.titlesize": 10, "axes.labelsize": 9, "legend.fontsize": 8, "mathtext.fontset": "dejavusans",
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.alpha": 0.25, "lines.linewidth": 1.5,
    "savefig.dpi": 90,
})


def read_table(path):
    """Columns of a CSV file with a header line, by name."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    values = np.array(rows[1:], dtype=float).reshape(len(rows) - 1, len(rows[0]))
    return {name: values[:, i] for i, name in enumerate(rows[0])}


def trigonometric(values, odd, factor):
    """Values at t = j pi/N of a sine (odd) or cosine series, at factor times as many t."""
    n = len(values) - 1
    k = np.arange(n + 1)
    t = np.pi * np.arange(factor * n + 1) / (factor * n)
    basis = np.sin if odd else np.cos
    return basis(np.outer(t, k[1:-1] if odd else k)) @ np.linalg.solve(
        basis(np.pi * np.outer(k[1:-1] if odd else k, k[1:-1] if odd else k) / n), values[1:-1] if odd else values)


def smooth(shape, factor=8):
    """A table of a spectral shape's nodes, evaluated between them: radial components are sine series, others cosine
    series; the arc length is a multiple of t plus a sine series."""
    fine = {}
    for name, values in shape.items():
        if name == "arc_length":
            ramp = np.linspace(values[0], values[-1], len(values))
            fine[name] = np.linspace(values[0], values[-1], factor * (len(values) - 1) + 1)
            fine[name] += trigonometric(values - ramp, True, factor)
        else:
            fine[name] = trigonometric(values, name == "r" or name.endswith("_r"), factor)
    return fine


def read_run(directory):
    directory = pathlib.Path(directory)
    with open(directory / "summary.json") as file:
        summary = json.load(file)
    shape = read_table(directory / "shape.csv")
    if summary.get("discretization") == "spectral":
        shape = smooth(shape)
    return summary, shape, read_table(directory / "history.csv")


def read_flow(path):
    """x, z, and the axial velocity relative to the centroid, on the grid of a flow.vts file; None without the file."""
    if not path.exists():
        return None
    piece = ElementTree.parse(path).getroot().find("StructuredGrid/Piece")
    extent = [int(v) for v in piece.get("Extent").split()]
    shape = (extent[5] + 1, extent[1] + 1)

    def array(parent, name):
        node = piece.find(f"{parent}/DataArray[@Name='{name}']")
        return np.array(node.text.split(), dtype=float).reshape(*shape, int(node.get("NumberOfComponents")))

    points = array("Points", "Points")
    velocity = array("PointData", "relative_velocity")
    return points[0, :, 0], points[:, 0, 2], velocity[..., 2]


def cross_section(shape):
    """The closed curve: up on the right, down on the left."""
    return np.append(shape["r"], -shape["r"][::-1]), np.append(shape["z"], shape["z"][::-1])


def draw_drive(axes, summary):
    """Gravity or flow as an arrow at the left edge; the flow in a tube as its profile below the vesicle."""
    parameters = summary.get("parameters", {})
    wall = summary.get("tube_radius")
    arrow = {"arrowstyle": "-|>", "color": "black", "lw": 1.2, "mutation_scale": 9}
    if wall and "capillary_number" in parameters:
        bottom, top = axes.get_ylim()
        base = bottom + 0.02 * (top - bottom)
        height = 0.1 * (top - bottom)
        for x in np.linspace(-0.75, 0.75, 7):
            axes.annotate("", (x * wall, base + height * (1 - x * x)), (x * wall, base), arrowprops=arrow)
        return
    if "capillary_number" in parameters or "unbounded_capillary_number" in parameters:
        start, end, label = 0.12, 0.30, "flow"
    elif "bond" in parameters:
        start, end, label = 0.30, 0.12, "gravity"
    else:
        return
    axes.annotate("", (0.13, end), (0.13, start), xycoords="axes fraction",
                  arrowprops=arrow | {"lw": 1.6, "mutation_scale": 14})
    axes.text(0.13, 0.09, label, transform=axes.transAxes, ha="center", va="top")


def frame_shape(axes, shapes, summary, margin):
    radius = max(np.max(s["r"]) for s in shapes)
    low = min(np.min(s["z"]) for s in shapes)
    high = max(np.max(s["z"]) for s in shapes)
    wall = summary.get("tube_radius")
    half = wall * 1.12 if wall else radius + margin
    if wall:
        for side in (-1, 1):
            axes.axvspan(side * wall, side * half, color="0.75", lw=0)
            axes.axvline(side * wall, color="0.3", lw=1.2)
    axes.set_xlim(-half, half)
    axes.set_ylim(low - margin, high + margin)
    axes.set_aspect("equal")
    axes.set_xlabel(r"$r/R_0$")
    axes.set_ylabel(r"$(z - z_c)/R_0$")


def draw_streamlines(axes, reach, x, z, w):
    """Contours of the stream function Int w r dr, in the frame of the centroid; symmetric, as the flow is."""
    visible = (x >= 0) & (x <= reach + x[1] - x[0])
    r = x[visible]
    integrand = w[:, visible] * r
    psi = np.zeros_like(integrand)
    psi[:, 1:] = np.cumsum((integrand[:, 1:] + integrand[:, :-1]) / 2 * np.diff(r), axis=1)
    scale = np.max(np.abs(psi))
    backflow = min(np.max(psi), -np.min(psi)) > 0.01 * scale
    # Without backflow psi grows with the square of the radius, far from the vesicle.
    levels = scale * np.linspace(0, 1, 13 if backflow else 15)[1:] ** (1 if backflow else 2)
    levels = np.concatenate([-levels[::-1], levels])
    for side in (-1, 1):
        axes.contour(side * r, z, psi, levels=levels, colors="0.72", linewidths=0.7, linestyles="solid", zorder=1)


def draw_shape(figure, axes, summary, shape, flow):
    axes.grid(False)
    x, z = cross_section(shape)
    if flow is not None:
        draw_streamlines(axes, np.max(shape["r"]) + 0.75, *flow)
    axes.fill(x, z, color="#fbe9d9", zorder=2)
    if "tension" in shape:
        tension = np.append(shape["tension"], shape["tension"][::-1])
        points = np.column_stack([x, z])
        segments = np.stack([points[:-1], points[1:]], axis=1)
        lines = matplotlib.collections.LineCollection(segments, cmap="viridis", linewidth=3, zorder=3,
                                                      capstyle="round")
        lines.set_array((tension[:-1] + tension[1:]) / 2)
        axes.add_collection(lines)
        figure.colorbar(lines, ax=axes, label=r"tension ($\kappa/R_0^2$)", fraction=0.05, pad=0.03, shrink=0.75)
    else:
        axes.plot(x, z, color="#b5541c", lw=2.5, zorder=3)
    axes.axvline(0, color="0.5", lw=0.6, ls=(0, (8, 4)), zorder=1)
    frame_shape(axes, [shape], summary, 0.75)
    draw_drive(axes, summary)
    axes.set_title("shape, " + ("stationary" if summary["stationary"] else f"at time {summary['time']:.3g}"))


def draw_history(axes, history):
    time = history["time"]
    plain = {"marker": "." if len(time) < 3 else None}
    axes[0].plot(time, history["velocity"], color="#1f5fa8", **plain)
    axes[0].set_ylabel(f"velocity\n({VELOCITY})")
    axes[0].ticklabel_format(axis="y", useOffset=False)
    axes[1].semilogy(time, np.maximum(history["residual"], 1e-16), color="#b5541c", **plain)
    axes[1].set_ylabel("residual")
    if np.any(history["bending_energy"] > 0):
        axes[2].plot(time, history["bending_energy"] / (8 * np.pi), color="#2b7a4b", **plain)
        axes[2].ticklabel_format(axis="y", useOffset=False)
    axes[2].set_ylabel("bending energy\n" + r"($8\pi\kappa$)")
    for name, color in (("area_error", "#6a3d9a"), ("volume_error", "#d08a00")):
        axes[3].semilogy(time, np.maximum(np.abs(history[name]), 1e-16), color=color, lw=1.1,
                         label=name.split("_")[0] + ", in a step")
    for name, color in (("area_drift", "#6a3d9a"), ("volume_drift", "#d08a00")):
        axes[3].semilogy(time, np.maximum(np.abs(history[name]), 1e-16), color=color, lw=1.1, ls=":",
                         label=name.split("_")[0] + ", after correction")
    axes[3].set_ylabel("relative drift")
    low, high = axes[3].get_ylim()
    axes[3].set_ylim(low, high * (high / low) ** 0.45)
    axes[3].legend(ncol=2, frameon=False, loc="upper right", fontsize=7, handlelength=1.2, columnspacing=0.8)
    axes[3].set_xlabel(f"time ({TIME})")
    axes[0].set_title("history")


def draw_profiles(axes, shape):
    s = shape["arc_length"]
    for name, label, color in (("force", "total", "#1f5fa8"), ("elastic_force", "bending", "#d08a00")):
        if name + "_r" in shape:
            for axis, direction in zip(axes[:2], "rz"):
                axis.plot(s, shape[f"{name}_{direction}"], color=color, label=label,
                          ls="-" if name == "force" else "--")
    axes[0].set_ylabel(f"$f_r$ ({FORCE})")
    axes[1].set_ylabel(f"$f_z$ ({FORCE})")
    axes[0].legend(frameon=False)
    if "tension" in shape:
        axes[2].plot(s, shape["tension"], color="#2b7a4b")
    axes[2].set_ylabel("tension\n" + r"($\kappa/R_0^2$)")
    axes[3].plot(s, shape["mean_curvature"], color="#b5541c")
    axes[3].set_ylabel("mean curvature\n" + r"($1/R_0$)")
    axes[3].set_xlabel(r"arc length from the lower pole ($R_0$)")
    axes[0].set_title("on the membrane")


def title_of(summary):
    names = {"excess_area": r"$\Delta$", "bond": r"$B_0$", "capillary_number": "Ca",
             "unbounded_capillary_number": r"Ca$_\mathrm{unb}$", "confinement": r"$R_0/R_c$", "aspect": "aspect"}
    parameters = summary.get("parameters", {})
    parts = [f"{names[k]} = {v:.4g}" for k, v in parameters.items() if k in names]
    parts.append(rf"$v$ = {summary['reduced_volume']:.4g}")
    parts.append(f"N = {summary['elements']}")
    if "velocity" in summary:
        parts.append(f"U = {summary['velocity']:.5g}")
    return "    ".join(parts)


def plot_run(directory):
    summary, shape, history = read_run(directory)
    figure = plt.figure(figsize=(12, 6.8), layout="constrained")
    grid = figure.add_gridspec(4, 3, width_ratios=(1.25, 1, 1))
    draw_shape(figure, figure.add_subplot(grid[:, 0]), summary, shape, read_flow(pathlib.Path(directory) / "flow.vts"))
    columns = []
    for column in (1, 2):
        first = figure.add_subplot(grid[0, column])
        columns.append([first] + [figure.add_subplot(grid[i, column], sharex=first) for i in (1, 2, 3)])
        for axes in columns[-1][:3]:
            axes.tick_params(labelbottom=False)
    if len(history["time"]):
        draw_history(columns[0], history)
    if "arc_length" in shape:
        draw_profiles(columns[1], shape)
    figure.suptitle(title_of(summary), fontsize=11)
    if "failure" in summary:
        figure.supxlabel("failed: " + summary["failure"], color="#b00020", fontsize=9, wrap=True)
    path = pathlib.Path(directory) / "summary.png"
    figure.savefig(path, pil_kwargs={"optimize": True})
    return path


def compare(directories, path, labels):
    runs = [read_run(d) for d in directories]
    figure, axes = plt.subplots(figsize=(6.5, 5), layout="constrained")
    axes.grid(False)
    colors = plt.get_cmap("tab10")
    for i, (directory, (_, shape, _)) in enumerate(zip(directories, runs)):
        x, z = cross_section(shape)
        label = labels[i] if labels else pathlib.Path(directory).name
        axes.plot(x, z, color=colors(i % 10), label=label, ls=("-", "--", "-.", ":")[i // 10 % 4])
    axes.axvline(0, color="0.5", lw=0.6, ls=(0, (8, 4)))
    frame_shape(axes, [shape for _, shape, _ in runs], runs[0][0], 0.25)
    draw_drive(axes, runs[0][0])
    axes.legend(frameon=False, loc="center left", bbox_to_anchor=(1.02, 0.5))
    figure.savefig(path, pil_kwargs={"optimize": True})
    return path


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", nargs="*", help="output directory of an example")
    parser.add_argument("--compare", nargs="+", metavar="DIR", help="overlay the final shapes of these runs")
    parser.add_argument("--labels", nargs="+", help="names of the compared runs (default: their directories')")
    parser.add_argument("--out", default="compare.png", help="file for the comparison (default: compare.png)")
    arguments = parser.parse_args()
    if not arguments.directory and not arguments.compare:
        parser.error("give the output directory of an example, or --compare DIR DIR ...")
    if arguments.labels and len(arguments.labels) != len(arguments.compare or []):
        parser.error("--labels: must be as many as the compared directories")
    try:
        for directory in arguments.directory:
            print(plot_run(directory))
        if arguments.compare:
            print(compare(arguments.compare, arguments.out, arguments.labels))
    except (OSError, KeyError, ValueError) as error:
        print(f"plot_run.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
