#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws work_precision.csv: error against seconds and against N. plot_work_precision.py DIR/work_precision.csv --out docs/gallery"""
import argparse
import csv
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "examples"))
from plot_run import plt  # noqa: E402

SCENES = {"drag 0.5": "drag of a sphere, $R_0/R_c$ = 0.5", "drag 0.9": "drag of a sphere, $R_0/R_c$ = 0.9",
          "settling": "settling vesicle, stationary (Fig. 5)",
          "unbounded": "vesicle in unbounded Poiseuille flow, stationary (Fig. 7)",
          "tube": "vesicle in a tube, stationary (Fig. 14)", "transient": "settling vesicle, time 0.1"}
STYLES = {"P1": ("#b5541c", "o-"), "P1, Euler": ("#b5541c", "o-"), "P1, Newton": ("#d08a00", "s--"),
          "P1, Euler, N = 65": ("#e0a080", "o-"), "P1, Euler, N = 130": ("#c97a50", "o-"),
          "P1, Euler, N = 260": ("#b5541c", "o-"), "spectral": ("#1f5fa8", "o-"), "spectral, Euler": ("#6fa3d8", "v-"),
          "spectral, order 2": ("#4a9a5a", "^-"), "spectral, order 3": ("#1f5fa8", "o-"),
          "spectral, adaptive": ("black", "s-"), "spectral, Newton": ("#7a3fa0", "D--")}


def read_lines(path):
    """{scene: {line: [(n, steps, seconds, error), ...]}}"""
    scenes = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            point = tuple(float(row[k]) for k in ("n", "steps", "seconds", "error"))
            scenes.setdefault(row["scene"], {}).setdefault(row["line"], []).append(point)
    return scenes


def draw(scenes, abscissa, label, path):
    """`abscissa(scene)`: index into a point."""
    fig, axes = plt.subplots(2, 3, figsize=(12.5, 7), layout="constrained")
    for axis, (scene, title) in zip(axes.flat, SCENES.items()):
        column, text = abscissa(scene), label(scene)
        for line, points in scenes.get(scene, {}).items():
            color, style = STYLES[line]
            axis.loglog([p[column] for p in points], [p[3] for p in points], style, ms=4, color=color, label=line)
        axis.set_title(title, fontsize=9)
        axis.set_xlabel(text)
        axis.set_ylabel("relative error")
        axis.legend(frameon=False, fontsize=7)
    fig.savefig(path, pil_kwargs={"optimize": True})
    print(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("table")
    parser.add_argument("--out", default="docs/gallery", help="directory for the pictures (default: docs/gallery)")
    arguments = parser.parse_args()
    out = pathlib.Path(arguments.out)
    try:
        scenes = read_lines(arguments.table)
        out.mkdir(parents=True, exist_ok=True)
        draw(scenes, lambda scene: 2, lambda scene: "seconds", out / "work_precision.png")
        draw(scenes, lambda scene: 1 if scene == "transient" else 0,
             lambda scene: "time steps" if scene == "transient" else "elements or modes N",
             out / "work_precision_n.png")
    except (OSError, KeyError, ValueError) as error:
        print(f"plot_work_precision.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
