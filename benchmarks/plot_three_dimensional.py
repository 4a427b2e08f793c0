#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the shapes of `three_dimensional DIR`: plot_three_dimensional.py DIR --out docs/gallery"""
import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "examples"))
from plot_run import plt, read_table  # noqa: E402


def centred(table):
    """z from the middle between the ends."""
    return table["z"] - (table["z"].min() + table["z"].max()) / 2


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("directory")
    parser.add_argument("--out", default="docs/gallery", help="directory for the picture (default: docs/gallery)")
    arguments = parser.parse_args()
    directory, out = pathlib.Path(arguments.directory), pathlib.Path(arguments.out)
    fig, axes = plt.subplots(1, 2, figsize=(7, 5), layout="constrained")
    for axis, (scene, title) in zip(axes, (("settling", "settling (Fig. 5)"),
                                           ("poiseuille", "unbounded Poiseuille flow (Fig. 7)"))):
        space = read_table(directory / f"{scene}_space_3.csv")
        meridian = read_table(directory / f"{scene}_260.csv")
        axis.plot(space["r"], centred(space), ".", ms=3, color="#b5541c", label="642 nodes in space")
        axis.plot(meridian["r"], centred(meridian), color="#1f5fa8", label="axisymmetric, N = 260")
        axis.set_title(title)
        axis.set_aspect("equal")
        axis.set_xlabel(r"$\rho/R_0$")
        axis.set_ylabel("$z/R_0$")
        axis.legend(frameon=False, loc="center left")
    out.mkdir(parents=True, exist_ok=True)
    fig.savefig(out / "three_dimensional.png", pil_kwargs={"optimize": True})
    print(out / "three_dimensional.png")


if __name__ == "__main__":
    main()
