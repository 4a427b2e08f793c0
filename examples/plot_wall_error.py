#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Velocity on the wall of a tube against the source's distance from it (Trozzo et al. 2015, Fig. 4).

test_tube_filon "[.report]" | examples/plot_wall_error.py --out docs/gallery/wall_error.png
"""
import argparse
import sys

import numpy as np

from plot_run import plt

CURVES = (("TubeKernel, tolerance 1e-13", "#1f5fa8", "o-"), ("TubeKernel, 1e-8", "#6fa3d8", "s-"),
          ("TubeFilonKernel, 1e-8", "#d08a00", "s--"), ("TubeFilonKernel, 1e-4", "#b5541c", "o--"))


def read_rows(lines):
    """The table's rows: a gap and an error per curve; other lines are the test runner's."""
    rows = []
    for line in lines:
        words = line.split()
        try:
            numbers = [float(word) for word in words]
        except ValueError:
            continue
        if len(numbers) == len(CURVES) + 1:
            rows.append(numbers)
    return np.array(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", required=True, help="picture to write")
    arguments = parser.parse_args()
    rows = read_rows(sys.stdin)
    if len(rows) == 0:
        sys.exit("plot_wall_error: no table on the standard input")
    figure, axes = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    for (label, color, style), errors in zip(CURVES, rows.T[1:]):
        axes.loglog(rows[:, 0], errors, style, color=color, label=label, markersize=4)
    axes.axhline(1e-3, color="0.6", linewidth=1, linestyle=":")
    axes.text(rows[:, 0].min(), 2e-4, "where the paper's saturates", color="0.4", fontsize=8)
    axes.set_xlabel("distance of the ring from the wall / $R_c$")
    axes.set_ylabel("velocity on the wall / that in free space")
    axes.set_ylim(1e-16, 1)
    axes.grid(alpha=0.3)
    axes.legend(loc="center left", bbox_to_anchor=(0.02, 0.25), fontsize=8)
    figure.savefig(arguments.out, dpi=150)


if __name__ == "__main__":
    main()
