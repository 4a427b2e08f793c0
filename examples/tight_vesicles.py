#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Vesicles in tubes hardly wider than they need: stationary states by poiseuille_vesicle, one row a case, and how
films and velocities go with the distance to the narrowest tube and with the flow, beside lubrication theory
(docs/tight_vesicles.md).

    python3 examples/tight_vesicles.py --bin build/examples > table.md
"""

import argparse
import json
import math
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

# (v, confinement/limit): velocity over the flow's mean and thinnest film over R0 in the limit of strong flows, from the
# data of J. M. Barakat & E. S. G. Shaqfeh, "The steady motion of a closely fitting vesicle in a tube", J. Fluid Mech.
# (2018) (github.com/jbarakat/ves_lub_highCa, output/v*/conf*, commit c448301: 1/(1 - Q2) and (1 - max r)
# (4 pi/(3 V))^(1/3) of their units).
LUBRICATION = {
    (0.6, 0.95): (1.05036, 0.02169), (0.6, 0.98): (1.02000, 0.00846), (0.6, 0.99): (1.00997, 0.00384),
    (0.8, 0.9): (1.10268, 0.05602), (0.8, 0.95): (1.04994, 0.02554), (0.8, 0.98): (1.01971, 0.00979),
    (0.8, 0.99): (1.00984, 0.00478),
    (0.95, 0.9): (1.09481, 0.06342), (0.95, 0.95): (1.04668, 0.02929), (0.95, 0.98): (1.01865, 0.01134),
    (0.95, 0.99): (1.00938, 0.00564),
}


def excess_area(v):
    """Over 4 pi R0^2, of reduced volume v."""
    return 4 * math.pi * (v ** (-2 / 3) - 1)


def narrowest_tube(v):
    """In R0: a cylinder with hemispherical ends fills it."""
    return 2 * v ** (-1 / 3) * math.sin(math.asin(v) / 3)


def run(program, v, share, capillary_number, timeout, options):
    """The summary, with the seconds of processor time it took; or the reason why there is none."""
    confinement = share / narrowest_tube(v)
    with tempfile.TemporaryDirectory() as directory:
        command = [program, "--excess-area", repr(excess_area(v)), "--confinement", repr(confinement),
                   "--capillary-number", repr(capillary_number), "--out", directory, *options]
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=timeout)
        except subprocess.TimeoutExpired:
            return f"not done after {timeout:g} s"
        if done.returncode != 0:
            return done.stderr.strip().split(": ", 1)[-1]
        summary = json.loads((Path(directory) / "summary.json").read_text())
        summary["seconds"] = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        return summary if summary["stationary"] else "not stationary"


def exponent(points):
    """Least-squares slope of log y over log x; None of fewer than two points."""
    logs = [(math.log(x), math.log(y)) for x, y in points]
    if len(logs) < 2:
        return None
    mx, my = (sum(p[i] for p in logs) / len(logs) for i in (0, 1))
    return sum((x - mx) * (y - my) for x, y in logs) / sum((x - mx) ** 2 for x, _ in logs)


def main():
    numbers = lambda text: [float(part) for part in text.split(",")]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", default="build/examples", help="where poiseuille_vesicle is")
    parser.add_argument("--reduced-volume", type=numbers, default=[0.6, 0.8, 0.95])
    parser.add_argument("--share", type=numbers, default=[0.9, 0.95, 0.98, 0.99, 0.995],
                        help="confinements over the largest one")
    parser.add_argument("--capillary-number", type=numbers, default=[1, 100, 1e4])
    parser.add_argument("--timeout", type=float, default=600, help="seconds for each")
    arguments, options = parser.parse_known_args()
    # Also states that are not stable.
    options = options or ["--preset-accuracy", "fast", "--stationary", "newton"]
    program = str(Path(arguments.bin) / "poiseuille_vesicle")

    print("| v | confinement/limit | Ca | velocity/mean | mean film | thinnest | pressure drop/Ca | s | error | modes |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    rows = []
    for v in arguments.reduced_volume:
        for share in arguments.share:
            for ca in arguments.capillary_number:
                s = run(program, v, share, ca, arguments.timeout, options)
                start = f"| {v:g} | {share:g} | {ca:g} | "
                if isinstance(s, str):
                    print(start + s + " | | | | | | |", flush=True)
                    continue
                ratio = s["velocity"] / (ca / 2)
                rows.append((v, share, ca, ratio, s["film_thickness_min"]))
                print(start + f"{ratio:.5f} | {s['film_thickness_mean']:.5f} | {s['film_thickness_min']:.5f} | "
                      f"{s['pressure_drop'] / ca:.4f} | {s['seconds']:.1f} | {s['error_estimate']:.1e} | "
                      f"{s['elements']} |", flush=True)

    print("\n| v | Ca | thinnest film ~ (1 - confinement/limit)^n | velocity/mean - 1 ~ likewise |\n|---|---|---|---|")
    show = lambda n: "-" if n is None else f"{n:.3f}"
    for v in arguments.reduced_volume:
        for ca in arguments.capillary_number:
            these = [r for r in rows if r[0] == v and r[2] == ca]
            print(f"| {v:g} | {ca:g} | {show(exponent([(1 - r[1], r[4]) for r in these]))} | "
                  f"{show(exponent([(1 - r[1], r[3] - 1) for r in these if r[3] > 1]))} |")
    print("\n| v | confinement/limit | thinnest film ~ Ca^n |\n|---|---|---|")
    for v in arguments.reduced_volume:
        for share in arguments.share:
            print(f"| {v:g} | {share:g} | {show(exponent([(r[2], r[4]) for r in rows if r[:2] == (v, share)]))} |")
    print("\n| v | confinement/limit | velocity/mean, largest Ca | lubrication | difference | thinnest film | lubrication | "
          "relative difference |\n|---|---|---|---|---|---|---|---|")
    for v in arguments.reduced_volume:
        for share in arguments.share:
            these = [r for r in rows if r[:2] == (v, share)]
            if these and (v, share) in LUBRICATION:
                _, _, _, ratio, film = max(these, key=lambda r: r[2])
                velocity, thinnest = LUBRICATION[v, share]
                print(f"| {v:g} | {share:g} | {ratio:.5f} | {velocity:.5f} | {ratio - velocity:.1e} | {film:.5f} | "
                      f"{thinnest:.5f} | {film / thinnest - 1:.1e} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
