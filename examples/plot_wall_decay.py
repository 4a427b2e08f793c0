#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws how a particle's disturbance of the flow decays along a tube: plot_wall_decay.py FILE [FILE ...] --out PICTURE.

The files are wall_decay.csv of wall_study (spheres) and of wall_vesicles.
"""
import argparse
import csv
import pathlib
import sys

import numpy as np

from plot_run import plt

# First root of the tube's eigenvalue equation J0^2 + J1^2 = 2 J0 J1/k.
RATE, WAVE_NUMBER = 4.46630, 1.46747
COLOURS = ["#1f5fa8", "#2b7a4b", "#d08a00", "#b5541c"]


def read_cases(path):
    """(label, |z|/Rc, mean, rate, wave number) of each case and side in the file."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    cases = {}
    for row in rows:
        z = float(row["z_over_tube_radius"])
        label = f"{row['case']}, $R_c$ = {float(row['tube_radius']):.3g} $R_0$"
        if row["case"] == "vesicle":
            label += ", downstream" if z > 0 else ", upstream"
        cases.setdefault(label, []).append([abs(z)] + [float(row[k]) for k in ("mean", "rate", "wave_number")])
    return [(label, *np.array(values).T) for label, values in cases.items()]


def draw(cases, path):
    figure, (means, rates) = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained", width_ratios=(1.4, 1))
    for i, (label, z, mean, rate, wave_number) in enumerate(cases):
        colour = COLOURS[min(i, len(COLOURS) - 1)]
        style = {"color": colour, "ls": "--" if label.endswith("upstream") else "-"}
        means.semilogy(z, mean, marker="o", ms=3, label=label, **style)
        # The sections of a fit end at z.
        rates.plot(z, rate, marker="o", ms=3, **style)
        rates.plot(z, wave_number, marker="s", ms=3, **style)
    z = np.array(means.get_xlim())
    means.semilogy(z, 4 * np.exp(-RATE * (z - 1)), color="0.4", lw=1, ls=":", label=rf"$\exp(-{RATE:.4f}\,z/R_c)$")
    means.set(xlabel="$z/R_c$", ylabel="mean of $|u'|$ over the section / scale")
    means.legend(fontsize=7.5)
    for value, name in ((RATE, f"decay rate, {RATE:.4f}"), (WAVE_NUMBER, f"wave number, {WAVE_NUMBER:.4f}")):
        rates.axhline(value, color="0.4", lw=1, ls=":")
        rates.text(rates.get_xlim()[1], value + 0.12, name, ha="right", fontsize=8)
    rates.set(xlabel="$z/R_c$", ylabel=r"fitted $k R_c$", ylim=(0.8, 5.6))
    figure.savefig(path, dpi=110, pil_kwargs={"optimize": True})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("docs/gallery/wall_decay.png"))
    arguments = parser.parse_args()
    try:
        draw([case for path in arguments.files for case in read_cases(path)], arguments.out)
    except (OSError, KeyError, ValueError) as error:
        print(f"plot_wall_decay.py: {error}", file=sys.stderr)
        return 2
    print(arguments.out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
