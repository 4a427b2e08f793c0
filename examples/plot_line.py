#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws what bodies_in_line wrote: the shapes kept on the way, and the distances and velocities of the bodies.

    python3 examples/plot_line.py DIR      writes DIR/line.png
"""

import argparse
import json
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def table(path):
    return np.genfromtxt(path, delimiter=",", names=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path)
    directory = parser.parse_args().directory
    summary = json.loads((directory / "summary.json").read_text())
    frames = table(directory / "frames.csv")
    count = len(summary["bodies"])
    histories = [table(directory / f"history_{b}.csv") for b in range(count)]

    figure, (shapes, gaps, speeds) = plt.subplots(
        3, 1, figsize=(9, 9), gridspec_kw={"height_ratios": [2, 1, 1]}, constrained_layout=True
    )
    numbers = np.unique(frames["frame"])
    for number in numbers:
        at = frames["frame"] == number
        shade = 0.25 + 0.75 * (number + 1) / len(numbers)
        offset = 3.0 * number
        for body in range(count):
            mine = at & (frames["body"] == body)
            for sign in (1, -1):
                shapes.plot(frames["z"][mine], offset + sign * frames["r"][mine], color="#1f5fa8", alpha=shade)
        shapes.annotate(f"t = {frames['time'][at][0]:.3g}", (frames["z"][at].max(), offset), xytext=(8, 0),
                        textcoords="offset points", va="center")
    if "tube_radius" in summary:
        for number in numbers:
            for sign in (1, -1):
                shapes.axhline(3.0 * number + sign * summary["tube_radius"], color="black", linewidth=0.8)
    shapes.set_aspect("equal")
    shapes.set_xlabel("z / R0")
    shapes.set_yticks([])

    if histories[0].size > 1:
        for body in range(count):
            speeds.plot(histories[body]["time"], histories[body]["velocity"], label=f"body {body}")
            if body:
                gaps.plot(histories[body]["time"], histories[body]["position"] - histories[body - 1]["position"],
                          label=f"{body - 1} to {body}")
        gaps.legend(fontsize=7)
        speeds.legend(fontsize=7)
    gaps.set_ylabel("centre to centre / R0")
    speeds.set_ylabel("velocity")
    speeds.set_xlabel("time")
    figure.savefig(directory / "line.png", dpi=110)


if __name__ == "__main__":
    main()
