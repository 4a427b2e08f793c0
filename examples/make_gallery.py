#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the examples in a tube and draws docs/gallery: make_gallery.py --bin build/examples [FIGURE ...].

Without names it makes all figures. Each prints its commands, the time it took, and its numbers as a table.
"""
import argparse
import pathlib
import shlex
import subprocess
import sys
import time

import numpy as np

from plot_run import cross_section, plt, read_run, read_table

WALL = "0.72"
BLUE, ORANGE, BROWN = "#1f5fa8", "#d08a00", "#b5541c"
# Drag factors of tests/sphere_in_tube_reference.hpp.
DRAG = {"0.1": 1.263213905, "0.3": 2.370094890, "0.5": 5.947374246, "0.7": 24.67598385, "0.9": 469.2243905,
        "1/1.1": 601.5115068}
FIGURES = {}


def figure(make):
    FIGURES[make.__name__.replace("_", "-")] = make
    return make


def value(text):
    """A number, or a ratio such as 1/0.9."""
    top, _, bottom = text.partition("/")
    return float(top) / float(bottom or 1)


class Gallery:
    """Where programs are, where runs and pictures go; seconds spent in programs."""

    def __init__(self, arguments):
        self.programs = pathlib.Path(arguments.bin)
        self.work = pathlib.Path(arguments.work)
        self.out = pathlib.Path(arguments.out)
        self.reuse = arguments.reuse

    def run(self, name, program, **options):
        """Summary, shape and history of a run; confinements may be ratios. A run that is no success ends the script."""
        directory = self.work / name
        if not (self.reuse and (directory / "summary.json").exists()):
            words = [str(self.programs / program)]
            for key, option in options.items():
                number = repr(value(option)) if key == "confinement" else str(option)
                words += ["--" + key.replace("_", "-"), number]
            words += ["--out", str(directory)]
            print("$", shlex.join(words), flush=True)
            subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
        return read_run(directory)

    def table(self, name, file="traction.csv"):
        return read_table(self.work / name / file)

    def save(self, fig, name):
        path = self.out / (name + ".png")
        fig.savefig(path, pil_kwargs={"optimize": True})
        plt.close(fig)
        print(path)


def print_table(header, rows):
    """Markdown."""
    print("\n| " + " | ".join(header) + " |\n|" + "---|" * len(header))
    for row in rows:
        print("| " + " | ".join(f"{v:.5g}" if isinstance(v, float) else str(v) for v in row) + " |")
    print()


KEYS = {"velocity": "U", "mobility": "mobility", "film_thickness_min": "least film", "film_thickness_mean": "mean film",
        "pressure_drop": "pressure drop", "length": "length", "steps": "steps", "wall_seconds": "seconds"}


def print_runs(first, labelled):
    """`labelled`: (label, summary) pairs, `first` the heading of the labels."""
    keys = [k for k in KEYS if any(k in s for _, s in labelled)]
    print_table([first] + [KEYS[k] for k in keys], [[label] + [s.get(k, "") for k in keys] for label, s in labelled])


def sideways(shape, centre=True):
    """Cross-section with the axis horizontal: x = z, y = r; z from the middle between the poles."""
    y, x = cross_section(shape)
    return (x - (shape["z"][0] + shape["z"][-1]) / 2 if centre else x), y


def draw_tube(axes, radius, reach, flow=None, gravity=False):
    """Axis, walls, and what drives: a Poiseuille profile at the left end, or an arrow for gravity, both along x."""
    axes.grid(False)
    axes.set_aspect("equal")
    axes.axhline(0, color="0.6", lw=0.6, ls=(0, (8, 4)), zorder=1)
    low, high = reach
    arrow = {"arrowstyle": "-|>", "color": "0.35", "lw": 0.8, "mutation_scale": 6, "shrinkA": 0, "shrinkB": 0}
    if radius:
        for side in (-1, 1):
            axes.axhspan(side * radius, side * radius * 1.1, color=WALL, lw=0)
            axes.axhline(side * radius, color="0.3", lw=1)
        axes.set_ylim(-1.1 * radius, 1.1 * radius)
    if flow:
        for y in np.linspace(-0.8, 0.8, 7):
            axes.annotate("", (low + flow * (1 - y * y), y * radius), (low, y * radius), arrowprops=arrow)
    if gravity:
        axes.annotate("", (low + 1, 0), (low + 0.2, 0), arrowprops=arrow | {"lw": 1.2, "mutation_scale": 10})
        axes.text(low + 0.6, 0.08 * (radius or 1), "gravity", ha="center", va="bottom", fontsize=7, color="0.25")
    axes.set_xlim(low, high)


def distance(a, b):
    """Largest distance of a node of either meridian from the other one, centroids at z = 0 in both."""
    def one_way(p, q):
        start, step = q[:-1], np.diff(q, axis=0)
        t = np.einsum("ijk,jk->ij", p[:, None] - start, step) / np.sum(step**2, axis=1)
        nearest = start + np.clip(t, 0, 1)[..., None] * step
        return np.max(np.min(np.linalg.norm(p[:, None] - nearest, axis=2), axis=1))
    p, q = (np.column_stack([s["r"], s["z"]]) for s in (a, b))
    return max(one_way(p, q), one_way(q, p))


@figure
def sphere_drag(g):
    """Error of K against N."""
    fig, axes = plt.subplots(1, 3, figsize=(13, 4.2), layout="constrained")
    counts = [16, 32, 64, 128, 256]
    modes = [8, 12, 16, 24, 32, 48]
    rows = []
    spectral_rows = []
    colors = plt.get_cmap("viridis")(np.linspace(0, 0.9, len(DRAG)))
    for (label, exact), color in zip(DRAG.items(), colors):
        k = []
        for n in counts:
            summary, _, _ = g.run(f"drag_{label.replace('/', '_')}_{n}", "sphere_in_tube", confinement=label, elements=n,
                                  discretization="linear")
            k.append(summary["drag_factor"])
        error = np.abs(np.array(k) / exact - 1)
        extrapolated = np.abs((4 * np.array(k[1:]) - np.array(k[:-1])) / 3 / exact - 1)
        axes[0].loglog(counts, error, "o-", ms=4, color=color, label=f"$R_0/R_c$ = {label}")
        axes[1].loglog(counts[1:], extrapolated, "o-", ms=4, color=color)
        order = np.log2(error[:-1] / error[1:])
        rows.append([label, f"{exact:.9g}"] + [f"{e:.1e}" for e in error] + [f"{order[0]:.2f}", f"{order[-1]:.2f}",
                    f"{extrapolated[-1]:.1e}", f"{np.log2(extrapolated[-2] / extrapolated[-1]):.2f}"])
        k = []
        for n in modes:
            summary, _, _ = g.run(f"drag_{label.replace('/', '_')}_spectral_{n}", "sphere_in_tube", confinement=label,
                                  elements=n, discretization="spectral", tolerance=1e-11)
            k.append(summary["drag_factor"])
        error = np.abs(np.array(k) / exact - 1)
        axes[2].semilogy(modes, error, "o-", ms=4, color=color)
        spectral_rows.append([label] + [f"{e:.1e}" for e in error])
    n = np.array(counts, dtype=float)
    axes[0].loglog(n, 3 / n**2, "k:", lw=1, label=r"$N^{-2}$")
    axes[0].loglog(n, 300 / n**3, "k--", lw=1, label=r"$N^{-3}$")
    axes[1].loglog(n[1:], 300 / n[1:]**3, "k--", lw=1, label=r"$N^{-3}$")
    axes[0].set_title("drag factor of a sphere: relative error")
    axes[1].set_title("extrapolated from N/2 and N: (4 K(N) - K(N/2))/3")
    axes[2].set_title("spectral meridian")
    axes[2].set_xlabel("modes N")
    for a in axes[:2]:
        a.set_xlabel("elements N")
        a.set_xticks(counts, [str(c) for c in counts])
        a.minorticks_off()
        a.legend(frameon=False, fontsize=7)
    g.save(fig, "sphere_drag")
    print_table(["R0/Rc", "K"] + [f"error, N = {c}" for c in counts] +
                ["order, first", "order, last", "extrapolated, 256", "its order"], rows)
    print_table(["R0/Rc"] + [f"spectral, N = {n}" for n in modes], spectral_rows)


@figure
def sphere_traction(g):
    """Traction along the meridian of a dragged sphere, over its mean drag per area."""
    fig, axes = plt.subplots(1, 2, figsize=(9.5, 3.8), layout="constrained")
    labels = ["0.1", "0.3", "0.5", "0.7", "0.9", "1/1.1"]
    rows = []
    for label, color in zip(labels, plt.get_cmap("viridis")(np.linspace(0, 0.9, len(labels)))):
        name = f"drag_{label.replace('/', '_')}_256"
        summary, _, _ = g.run(name, "sphere_in_tube", confinement=label, elements=256, discretization="linear")
        table = g.table(name)
        # The sphere settles along -z, and the fluid's traction on it is the opposite of its own on the fluid.
        mean = 1.5 * summary["drag_factor"] * -summary["velocity"]
        traction = {k: -table[k] / mean for k in ("f_r", "f_z")}
        for a, component in zip(axes, traction):
            a.plot(table["angle"], traction[component], color=color, label=f"$R_0/R_c$ = {label}")
        f_z = traction["f_z"]
        rows.append([label, 1.5 * summary["drag_factor"], float(np.max(f_z)), float(np.min(f_z)),
                     f"{np.max(np.abs(f_z - f_z[::-1])):.0e}"])
    for a, component in zip(axes, ("$f_r$", "$f_z$")):
        a.set_xticks(np.pi * np.linspace(-0.5, 0.5, 5), [r"$-\pi/2$", r"$-\pi/4$", "0", r"$\pi/4$", r"$\pi/2$"])
        a.set_xlabel("angle from the equator (upwind to downwind)")
        a.set_ylabel(component + " over the mean of $f_z$")
    axes[1].set_ylim(0, None)
    axes[1].legend(frameon=False, fontsize=7)
    fig.suptitle("traction on a sphere dragged along a tube, up to a multiple of the normal", fontsize=10)
    g.save(fig, "sphere_traction")
    print_table(["R0/Rc", "mean f_z (eta U/R0)", "largest/mean", "least/mean", "fore-aft asymmetry"], rows)


def draw_forces(axes, runs):
    """`runs`: (label, shape) pairs; the profiles of f_r and f_z over z."""
    styles = ["-", "--", ":"]
    for (label, shape), style in zip(runs, styles):
        z = shape["z"] - (shape["z"][0] + shape["z"][-1]) / 2
        axes.plot(z, shape["force_r"], color=BLUE, ls=style, label=f"$f_r$, {label}")
        axes.plot(z, shape["force_z"], color=ORANGE, ls=style, label=f"$f_z$, {label}")
    axes.set_ylabel(r"force density ($\kappa/R_0^3$)")
    axes.set_xlabel(r"$z/R_0$ from the middle")
    axes.legend(frameon=False, fontsize=7, ncol=2)


def refinement(g, name, title, counts, **options):
    """Shapes and force profiles of one case on several meshes."""
    runs = [(n, *g.run(f"{name}_{n}", "poiseuille_vesicle", elements=n, **options)) for n in counts]
    radius = runs[0][1]["tube_radius"]
    reach = max(s["length"] for _, s, _, _ in runs) / 2 + 0.35
    fig, axes = plt.subplots(2, 1, figsize=(8, 6.6), layout="constrained")
    for (n, _, shape, _), color, style in zip(runs, (BROWN, BLUE, "black"), ("-", "--", ":")):
        x, y = sideways(shape)
        axes[0].plot(x, y, color=color, ls=style, label=f"N = {n}")
    draw_tube(axes[0], radius, (-reach - 0.6, reach), 0.45)
    axes[0].legend(frameon=False, fontsize=8, loc="center")
    axes[0].set_ylabel(r"$r/R_0$")
    axes[0].set_title(title)
    draw_forces(axes[1], [(f"N = {n}", shape) for n, _, shape, _ in runs])
    axes[1].set_xlim(axes[0].get_xlim())
    g.save(fig, name)
    print_runs("N", [(n, s) for n, s, _, _ in runs])
    print_table(["N", "distance to the shape at the largest N"],
                [[n, float(distance(shape, runs[-1][2]))] for n, _, shape, _ in runs[:-1]])


@figure
def vesicle_in_tube(g):
    """A moderately confined vesicle at three meshes."""
    refinement(g, "vesicle_in_tube", r"$\Delta$ = 1.59, $R_c/R_0$ = 0.9, Ca = 100", (34, 65, 120), excess_area=1.59,
               confinement="1/0.9", capillary_number=100, discretization="linear")


@figure
def narrow_tube(g):
    """A vesicle like a red blood cell in a very narrow pore."""
    refinement(g, "narrow_tube", r"$\Delta$ = 4.8, $R_c/R_0$ = 0.55, Ca = 100", (64, 96, 128),
               excess_area=4.8, confinement="1/0.55", capillary_number=100, stationary="newton")


def draw_frames(axes, frames, radius, spacing):
    """Successive shapes, left to right; the times as labels."""
    low, high = 0.0, 0.0
    for i in range(int(frames["frame"][-1]) + 1):
        chosen = frames["frame"] == i
        shape = {k: frames[k][chosen] for k in ("r", "z")}
        x, y = sideways(shape)
        axes.plot(x + i * spacing, y, color=BROWN)
        axes.fill(x + i * spacing, y, color="#fbe9d9")
        axes.text(i * spacing, radius * 0.8, f"t = {frames['time'][chosen][0]:.3g}", ha="center", fontsize=8)
        low, high = min(low, np.min(x)), max(high, np.max(x) + i * spacing)
    draw_tube(axes, radius, (low - 0.9, high + 0.3), 0.6)


@figure
def initial_shapes(g):
    """Prolate and oblate starts end in one shape."""
    fig, axes = plt.subplots(2, 1, figsize=(8.5, 6.4), layout="constrained")
    for a, kind in zip(axes, ("prolate", "oblate")):
        g.run(f"start_{kind}", "poiseuille_vesicle", excess_area=0.2, confinement="0.5", capillary_number=100,
              elements=48, initial=kind, frame_times="0,0.01,0.03,0.13", time=0.13)
        draw_frames(a, g.table(f"start_{kind}", "frames.csv"), 2, 2.7)
        a.set_title(f"{kind} start, $\\Delta$ = 0.2, $R_c/R_0$ = 2, Ca = 100")
        a.set_ylabel(r"$r/R_0$")
        a.set_xticks([])
    g.save(fig, "initial_shapes")
    print_starts([both_starts(g, "0.2", "0.5", 100), both_starts(g, "0.9", "0.3", 100)])


@figure
def two_branches(g):
    """At small capillary numbers the two starts end in different shapes, a bullet and a parachute."""
    starts = {ca: both_starts(g, "0.9", "0.3", ca) for ca in (1, 3, 10, 20, 40, 100)}
    fig, axes = plt.subplots(1, 4, figsize=(11, 4), layout="constrained", sharey=True)
    drawn = [(ca, kind, shape) for ca in (1, 10) for kind, (_, shape, _) in zip(("prolate", "oblate"), starts[ca][1])]
    for a, (ca, kind, shape) in zip(axes, drawn):
        x, y = sideways(shape)
        a.fill(x, y, color="#fbe9d9")
        a.plot(x, y, color=BROWN)
        draw_tube(a, 1 / 0.3, (-2.9, 1.9), 0.8)
        a.set_title(f"Ca = {ca}, {kind} start")
    axes[0].set_ylabel(r"$r/R_0$")
    g.save(fig, "two_branches")
    print_starts(starts.values())


def both_starts(g, area, confinement, ca):
    """A label and the runs from the prolate and from the oblate spheroid."""
    runs = [g.run(f"start_{kind}_{area}_{confinement}_{ca}", "poiseuille_vesicle", excess_area=area,
                  confinement=confinement, capillary_number=ca, elements=48, initial=kind, tolerance=1e-8)
            for kind in ("prolate", "oblate")]
    return f"D = {area}, R0/Rc = {confinement}, Ca = {ca}", runs


def print_starts(starts):
    rows = []
    for label, ((a, one, _), (b, two, _)) in starts:
        pairs = [f"{a[k]:.6g}, {b[k]:.6g}" for k in ("velocity", "length", "curvature_bottom", "steps")]
        rows.append([label, *pairs, f"{a['wall_seconds']:.2g}, {b['wall_seconds']:.2g}", f"{distance(one, two):.1e}"])
    print_table(["from prolate, oblate", "U", "length", "curvature of the rear", "steps", "seconds", "distance"], rows)


@figure
def bounded_unbounded(g):
    """A vesicle in a tube and in the unbounded flow of the same curvature."""
    ratios = ("10", "5", "3", "2")
    fig, axes = plt.subplots(1, 4, figsize=(11, 3.4), layout="constrained", sharey=True)
    rows = []
    for a, ratio in zip(axes, ratios):
        options = dict(excess_area=1.59, elements=48, tolerance=1e-7)
        tube, bounded, _ = g.run(f"bounded_{ratio}", "poiseuille_vesicle", confinement="1/" + ratio,
                                 capillary_number=100, **options)
        free, unbounded, _ = g.run(f"unbounded_{ratio}", "poiseuille_vesicle",
                                   unbounded_capillary_number=repr(100 / float(ratio) ** 2), **options)
        for shape, color, style, label in ((bounded, "#c0282d", "-", "tube"), (unbounded, BLUE, "--", "unbounded")):
            x, y = sideways(shape)
            a.plot(x, y, color=color, ls=style, label=label)
        draw_tube(a, None, (-2, 2))
        if float(ratio) < 2.5:
            for side in (-1, 1):
                a.axhspan(side * float(ratio), side * 2.2, color=WALL, lw=0)
        a.set_ylim(-2.15, 2.15)
        a.annotate("", (1.6, -1.7), (0.6, -1.7), arrowprops={"arrowstyle": "-|>", "color": "0.35"})
        a.text(0.5, -1.7, "flow", ha="right", va="center", fontsize=7)
        a.set_title(rf"$R_c/R_0$ = {ratio}")
        rows.append([ratio, 1 / float(ratio), 100 / float(ratio) ** 2, float(distance(bounded, unbounded)),
                     tube["lag"], free["lag"], tube["pressure_drop"], f"{tube['steps']}, {free['steps']}",
                     f"{tube['wall_seconds']:.2g}, {free['wall_seconds']:.2g}"])
    axes[0].legend(frameon=False, fontsize=7, loc="upper left")
    axes[0].set_ylabel(r"$r/R_0$")
    g.save(fig, "bounded_unbounded")
    print_table(["Rc/R0", "L", "Ca_unb", "largest distance", "lag, tube", "lag, unbounded", "pressure drop", "steps",
                 "seconds"], rows)


@figure
def experiments(g):
    """Parameters of three experiments with giant vesicles."""
    # The last one, from a prolate start, goes on oscillating.
    cases = ((0.45, "1.25", 10, "prolate"), (1.7, "1.5", 30, "prolate"), (2, "2.5", 60, "oblate"))
    fig, axes = plt.subplots(1, 3, figsize=(11, 3.4), layout="constrained")
    labelled = []
    for a, (area, ratio, ca, kind) in zip(axes, cases):
        summary, shape, _ = g.run(f"experiment_{area}", "poiseuille_vesicle", excess_area=area, confinement="1/" + ratio,
                                  capillary_number=ca, elements=48, initial=kind)
        x, y = sideways(shape)
        a.fill(x, y, color="#fbe9d9")
        a.plot(x, y, color=BROWN)
        draw_tube(a, float(ratio), (-2.9, 2.3), 0.6)
        a.set_title(rf"$\Delta$ = {area}, $R_c/R_0$ = {ratio}, Ca = {ca}")
        labelled.append((f"D = {area}, Rc/R0 = {ratio}, Ca = {ca}, {kind} start", summary))
    g.save(fig, "experiments")
    print_runs("case", labelled)


@figure
def settling_in_tube(g):
    """The tether of a settling vesicle shortens with confinement."""
    fig, axes = plt.subplots(2, 2, figsize=(9.5, 5.2), layout="constrained")
    labelled = []
    for a, ratio in zip(axes.flat, ("10", "5", "2", "1.15")):
        for n in (64, 96):
            summary, shape, _ = g.run(f"settling_{ratio}_{n}", "settling_vesicle", excess_area=0.93, bond=216,
                                      elements=n, confinement="1/" + ratio)
            labelled.append((f"{ratio}, N = {n}", summary))
        x, y = sideways(shape)
        a.fill(-x, y, color="#fbe9d9")
        a.plot(-x, y, color=BROWN)
        draw_tube(a, float(ratio), (-3.4, 2.6), gravity=True)
        a.set_ylim(-1.4, 1.4)
        a.set_title(rf"$R_c/R_0$ = {ratio}")
    g.save(fig, "settling_in_tube")
    print_runs("Rc/R0", labelled)


@figure
def tether(g):
    """The height of a heavy vesicle that pulls a tether, until it is stationary."""
    fig, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.6), width_ratios=(1, 1.5), layout="constrained")
    summary, _, history = g.run("tether", "tether", time=300, max_steps=40000, frame_times="0,0.5,1,20,300")
    left.semilogx(history["time"], history["length"], color=BROWN)
    left.set_xlabel(r"$t$ ($\eta R_0^3/\kappa$)")
    left.set_ylabel(r"height ($R_0$)")
    left.set_xlim(1e-3)
    frames = g.table("tether", "frames.csv")
    for k in np.unique(frames["frame"]):
        at = frames["frame"] == k
        z = frames["z"][at] - frames["z"][at][0]
        right.plot(np.concatenate([frames["r"][at], -frames["r"][at][::-1]]) + 2.2 * k, np.concatenate([z, z[::-1]]),
                   color=BROWN, lw=0.9)
        right.text(2.2 * k, -0.4, f"t = {frames['time'][at][0]:g}", ha="center", fontsize=8)
    right.set_aspect("equal")
    right.axis("off")
    g.save(fig, "tether")
    keys = ("velocity", "height", "tether_length", "tether_radius", "tether_radius_of_tension", "plateau_time",
            "elements", "steps", "wall_seconds", "error_estimate")
    rows = [["392, t = 300"] + [summary.get(k, "") for k in keys]]
    for bond in (100, 200, 392, 800, 2000):
        time = 1600 / bond
        other, _, _ = g.run(f"tether_{bond}", "tether", bond=bond, time=time)
        rows.append([f"{bond}, t = {time:.3g}"] + [other.get(k, "") for k in keys])
    print_table(["Bond number"] + [k.replace("_", " ") for k in keys], rows)


@figure
def pearling(g):
    """A thin tube under tension breaks up into pearls."""
    summary, _, _ = g.run("pearling", "pearling")
    frames = g.table("pearling", "frames.csv")
    fig, (top, bottom) = plt.subplots(2, 1, figsize=(9.5, 6.2), height_ratios=(1.7, 1), layout="constrained")
    for k in np.unique(frames["frame"]):
        at = frames["frame"] == k
        r, z = frames["r"][at], frames["z"][at] - frames["z"][at][0]
        top.fill(np.concatenate([r, -r[::-1]]) + 2.3 * k, np.concatenate([z, z[::-1]]), facecolor="#fbe9d9",
                 edgecolor=BROWN, lw=0.7)
        top.text(2.3 * k, -0.45, f"t = {1e4 * frames['time'][at][0]:.3g}e-4", ha="center", fontsize=8)
    top.set_aspect("equal")
    top.axis("off")
    # The tube of the last frame, its radius magnified.
    tube = z > 1.9
    bottom.fill_between(z[tube], r[tube], -r[tube], facecolor="#fbe9d9", edgecolor=BROWN, lw=0.7)
    bottom.set_ylim(-0.16, 0.16)
    bottom.set_xlabel(r"height above the lower pole ($R_0$); radius magnified by about five")
    g.save(fig, "pearling")
    keys = ("velocity", "height", "tether_length", "pearls", "tether_radius", "tension_over_bending", "elements",
            "steps", "wall_seconds", "error_estimate")
    print_table([k.replace("_", " ") for k in keys], [[summary.get(k, "") for k in keys]])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("figure", nargs="*", help="one of " + ", ".join(FIGURES) + "; default: all")
    parser.add_argument("--bin", default="build/examples", help="directory of the programs (default: build/examples)")
    parser.add_argument("--work", default="build/gallery", help="directory for the runs (default: build/gallery)")
    parser.add_argument("--out", default="docs/gallery", help="directory for the pictures (default: docs/gallery)")
    parser.add_argument("--reuse", action="store_true", help="draw runs that are in --work already")
    arguments = parser.parse_args()
    for name in arguments.figure:
        if name not in FIGURES:
            parser.error(f"figure {name}: must be one of " + ", ".join(FIGURES))
    gallery = Gallery(arguments)
    gallery.out.mkdir(parents=True, exist_ok=True)
    for name in arguments.figure or FIGURES:
        begin = time.monotonic()
        try:
            FIGURES[name](gallery)
        except (OSError, KeyError, ValueError, subprocess.CalledProcessError) as error:
            print(f"make_gallery.py: {name}: {error}", file=sys.stderr)
            return 2
        print(f"{name}: {time.monotonic() - begin:.1f} s\n", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
