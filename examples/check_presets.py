#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that each accuracy preset holds what it promises on the scenes of the gallery.

check_presets.py --bin build/examples [SCENE ...] prints a Markdown table: for each preset the relative error (the larger
one of velocity and length; of a passage that of the transit time), the number of elements and the seconds. Exact values
where there are; otherwise the preset `reference`, which in turn is compared with a run of 1.3 times as many elements.
Passages, for which `reference` would take hours, are compared with a run that is finer than `balanced`. Exits with 1 if a
preset misses.
"""
import argparse
import json
import pathlib
import shlex
import subprocess
import sys

PRESETS = {"fast": 1e-3, "balanced": 1e-6, "reference": 1e-10}
# Drag factors of tests/sphere_in_tube_reference.hpp.
DRAG = {"0.1": 1.26321390527, "0.3": 2.37009489017, "0.5": 5.94737424576, "0.7": 24.6759838510, "0.9": 469.224390521,
        "1/1.1": 601.511506823}
SCENES = {}


def scene(name, program, exact=None, finest=None, **options):
    """`finest`: options that with the preset balanced make what the others are compared with, instead of reference."""
    SCENES[name] = (program, options, exact, finest)


def ratio(text):
    top, _, bottom = text.partition("/")
    return repr(float(top) / float(bottom or 1))


for confinement, factor in DRAG.items():
    scene(f"10: sphere, L = {confinement}", "sphere_in_tube", ("drag_factor", factor), confinement=ratio(confinement))
for aspect in ("0.5", "2"):
    scene(f"spheroid, aspect {aspect}", "spheroid_drag", ("relative_error", None), aspect=aspect)
scene("5: settling", "settling_vesicle", excess_area=0.6, bond=47)
scene("5: settling, at time 0.05", "settling_vesicle", excess_area=0.6, bond=47, time=0.05)
scene("7: unbounded flow", "poiseuille_vesicle", excess_area=0.6, unbounded_capillary_number=0.5)
for volume, kind in (("0.8", "prolate"), ("0.65", "oblate")):
    scene(f"relaxation to v = {volume}, {kind}", "relaxing_vesicle", reduced_volume=volume, initial=kind)
scene("14: D = 1.59, Rc = 0.9", "poiseuille_vesicle", excess_area=1.59, confinement=ratio("1/0.9"))
scene("15: D = 4.8, Rc = 0.55", "poiseuille_vesicle", excess_area=4.8, confinement=ratio("1/0.55"),
      stationary="newton")  # marching takes a quarter of an hour
for kind in ("prolate", "oblate"):
    scene(f"16: D = 0.2, L = 0.5, {kind}", "poiseuille_vesicle", excess_area=0.2, confinement=0.5, initial=kind)
for ca, kind in ((1, "prolate"), (1, "oblate"), (10, "prolate"), (10, "oblate"), (100, "prolate")):
    scene(f"16: D = 0.9, L = 0.3, Ca = {ca}, {kind}", "poiseuille_vesicle", excess_area=0.9, confinement=0.3,
          capillary_number=ca, initial=kind)
for radius in ("10", "5", "3", "2"):
    scene(f"17: D = 1.59, Rc = {radius}", "poiseuille_vesicle", excess_area=1.59, confinement=ratio("1/" + radius))
scene("17: D = 1.59, unbounded, Ca_unb = 4", "poiseuille_vesicle", excess_area=1.59, unbounded_capillary_number=4)
for area, radius, ca, kind in ((0.45, "1.25", 10, "prolate"), (1.7, "1.5", 30, "prolate"), (2, "2.5", 60, "oblate")):
    scene(f"18: D = {area}, Rc = {radius}", "poiseuille_vesicle", excess_area=area, confinement=ratio("1/" + radius),
          capillary_number=ca, initial=kind)
for radius in ("10", "5", "2", "1.15"):
    scene(f"19: settling, Rc = {radius}", "settling_vesicle", excess_area=0.93, bond=216,
          confinement=ratio("1/" + radius))
for name, options in (("constriction", {"throat": 0.65}), ("pore", {"profile": "pore", "throat": 0.8})):
    scene(f"passage: {name}", "vesicle_through_constriction",
          finest={"elements": 128, "step_tolerance": 2e-8, "tolerance": 1e-7}, **options)


def plain(text):
    """As a directory's name."""
    return "".join(c if c.isalnum() or c in ".-" else "_" for c in text)


class Checker:
    def __init__(self, arguments):
        self.arguments = arguments
        self.work = pathlib.Path(arguments.work)

    def run(self, name, preset, **more):
        """The summary, or None for a run that failed or took too long."""
        program, options, _, finest = SCENES[name]
        directory = self.work / plain(name) / preset
        if more:
            directory = directory.with_name(preset + "_finer")
        added = [] if preset == "reference" or more else shlex.split(self.arguments.other)
        if added:
            directory = directory.with_name(preset + plain("".join(added)))
        vesicle = program.endswith("_vesicle")
        words = [str(pathlib.Path(self.arguments.bin) / program), "--preset-accuracy", preset, "--out", str(directory)]
        for key, value in {**options, **more}.items():
            words += ["--" + key.replace("_", "-"), str(value)]
        if vesicle and "time" not in options and "stationary" not in options:
            words += ["--stationary", self.arguments.stationary]
        words += added
        summary = directory / "summary.json"
        if not (self.arguments.reuse and summary.exists()):
            summary.unlink(missing_ok=True)
            try:
                subprocess.run(words, check=True, stdout=subprocess.DEVNULL,
                               timeout=(10 if finest else 1) * self.arguments.timeout)
            except (subprocess.CalledProcessError, subprocess.TimeoutExpired) as error:
                print(f"check_presets.py: {name}, {preset}: {error}", file=sys.stderr)
                return None
        with open(summary) as file:
            return json.load(file)

    def error(self, name, summary, other):
        program, _, exact, _ = SCENES[name]
        if exact:
            key, value = exact
            return abs(summary[key] / value - 1) if value else abs(summary[key])
        keys = {"relaxing_vesicle": ("length",),
                "vesicle_through_constriction": ("transit_time",)}.get(program, ("velocity", "length"))
        return max(abs(summary[k] / other[k] - 1) for k in keys)

    def row(self, name):
        _, options, exact, finest = SCENES[name]
        runs = {preset: self.run(name, preset) for preset in PRESETS if not (finest and preset == "reference")}
        best = self.run(name, "balanced", **finest) if finest else runs["reference"]
        cells, good = [name], True
        for preset, promised in PRESETS.items():
            summary, other = runs.get(preset), best
            if preset == "reference" and summary and not exact:
                other = self.run(name, preset, elements=int(1.3 * summary["elements"]))
            if summary is None or (other is None and not exact):
                cells += ["-", "", ""]
                good = good and preset not in runs
                continue
            error = self.error(name, summary, other)
            held = error <= promised
            good = good and held
            state = "" if summary.get("stationary", True) or "time" in options else " (not stationary)"
            missed = "" if held else " missed, as reported" if not summary.get("error_met", True) else " **missed**"
            cells += [f"{error:.1e}" + missed + state, str(summary["elements"]),
                      f"{summary['wall_seconds']:.2g}"]
        if best and "stable" in best:
            cells.append("yes" if best["stable"] else "no")
        else:
            cells.append("")
        return cells, good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="*", help="scenes whose names begin so; default: all")
    parser.add_argument("--bin", default="build/examples", help="directory of the programs (default: build/examples)")
    parser.add_argument("--work", default="build/presets", help="directory for the runs (default: build/presets)")
    parser.add_argument("--stationary", default="auto", help="auto, march or newton (default: auto)")
    parser.add_argument("--other", default="", metavar="OPTIONS",
                        help="of the programs, for fast and balanced: '--discretization linear', '--method wall'")
    parser.add_argument("--timeout", type=float, default=240,
                        help="seconds a run may take, a passage ten times that (default: 240)")
    parser.add_argument("--reuse", action="store_true", help="take runs that are in --work already")
    arguments = parser.parse_args()
    names = [n for n in SCENES if not arguments.scene or any(n.startswith(s) for s in arguments.scene)]
    if not names:
        parser.error("no such scene; there are: " + "; ".join(SCENES))
    checker = Checker(arguments)
    head = ["scene"] + [word for preset, eps in PRESETS.items() for word in (f"{preset} ({eps:.0e})", "N", "s")]
    print("| " + " | ".join(head + ["stable"]) + " |\n|" + "---|" * (len(head) + 1))
    all_good = True
    for name in names:
        cells, good = checker.row(name)
        all_good = all_good and good
        print("| " + " | ".join(cells) + " |", flush=True)
    return 0 if all_good else 1


if __name__ == "__main__":
    sys.exit(main())
