#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Maps where the example programs work: random scenes, one run each, judged by a referee of its own.

sweep.py run --programs build/examples    draws scenes and runs them; results are appended to a CSV, cases in it skipped
sweep.py show SEED INDEX                  the command line of a case, which follows from these two numbers alone
sweep.py report                           Markdown tables of the outcomes, and of each kind of trouble one command line
sweep.py draw                             maps of the outcomes over pairs of parameters, into docs/limits

The referee (referee.py) knows bounds and exact values that the library has no part in.
"""
import argparse
import collections
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import random
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

import referee

TROUBLE = ("CRASH", "WRONG", "NON-FINITE", "HANG", "DISAGREES")
FIELDS = ("seed", "index", "outcome", "seconds", "velocity", "error_estimate", "error_met", "elements", "steps", "message",
          "command", "second_seconds", "second_command")
MEMORY = 4 << 30
# Of the numeric options. Extreme draws take one of the ends.
RANGES = {"excess-area": (1e-6, 8), "bond": (1e-3, 1e5), "capillary-number": (1e-3, 1e4),
          "unbounded-capillary-number": (1e-3, 1e4), "elements": (8, 2000), "tolerance": (1e-12, 1e-2),
          "step-tolerance": (1e-12, 1e-2), "dt": (1e-6, 1), "time": (1e-5, 10), "max-steps": (1, 1000),
          "aspect": (1e-2, 1e2), "flow-rate": (1e-2, 1e4), "throat": (0.3, 1.5), "transition": (0.1, 10),
          "length": (1e-2, 10), "distance": (1e-1, 30), "wall-tolerance": (1e-11, 1e-1),
          "wall-length": (0.1, 10), "wall-elements": (2, 1000)}
WHOLE = {"elements", "max-steps", "count", "wall-elements"}
CHEAP = {"elements": 40, "max-steps": 12}


class Drawing:
    """The options of one scene, drawn by a generator of random numbers."""

    def __init__(self, rng):
        self.rng = rng
        self.options = {}

    def chance(self, probability):
        return self.rng.random() < probability

    def between(self, low, high):
        return math.exp(self.rng.uniform(math.log(low), math.log(high)))

    def number(self, name, probability=1.0, signed=False):
        if self.chance(probability):
            value = self.between(*RANGES[name])
            self.options[name] = -value if signed and self.chance(0.3) else value

    def choice(self, name, values, probability=1.0):
        if self.chance(probability):
            self.options[name] = self.rng.choice(values)

    def method(self):
        self.choice("discretization", ("linear", "spectral", "adaptive"), 0.6)
        self.choice("integrator", ("euler", "order2", "order3", "adaptive"), 0.35)
        self.choice("preset-accuracy", ("fast", "fast", "fast", "balanced", "reference"), 0.4)

    def elements(self, probability):
        """Mostly few, so that most runs are cheap."""
        if self.chance(probability):
            low, high = RANGES["elements"]
            self.options["elements"] = self.between(low, high if self.chance(0.15) else 150)

    def run(self):
        self.method()
        self.choice("stationary", ("auto", "march", "newton"), 0.4)
        self.elements(0.5)
        self.number("tolerance", 0.2)
        self.number("step-tolerance", 0.1)
        self.number("dt", 0.15)
        self.number("time", 0.25)
        self.number("max-steps", 0.5)

    def vesicle(self):
        # Half of them far from a sphere.
        self.options["excess-area"] = self.between(RANGES["excess-area"][0] if self.chance(0.5) else 0.05, 8)
        self.choice("initial", ("prolate", "oblate"), 0.6)

    def tube(self, excess_area):
        """Up to the tube that a cylinder with round ends just fits into, and a bit beyond; often close to that."""
        limit = referee.closest_confinement(excess_area)
        if self.chance(0.3):
            self.options["confinement"] = limit * (1 - 10 ** self.rng.uniform(-4, -0.5))
        else:
            self.options["confinement"] = self.between(0.01, 1.02 * limit)

    def mesh(self, probability):
        if self.chance(probability):
            self.options["method"] = "wall"
            self.number("wall-length", 0.2)
            if self.chance(0.3):
                self.number("wall-elements")
                self.choice("wall-grading", ("uniform", "quadratic"), 0.5)


def settling_vesicle(d):
    d.vesicle()
    d.number("bond", signed=True)
    if d.chance(0.4):
        d.tube(d.options["excess-area"])
    d.run()


def poiseuille_vesicle(d):
    d.vesicle()
    if d.chance(0.25):
        d.number("unbounded-capillary-number", signed=True)
    else:
        d.number("capillary-number", signed=d.chance(0.3))
        d.tube(d.options["excess-area"])
        d.mesh(0.25)
        if "method" in d.options:
            d.number("wall-tolerance", 0.4)
    d.run()


def relaxing_vesicle(d):
    d.vesicle()
    d.run()


def sphere_in_tube(d):
    d.tube(0)
    d.choice("flow", ("none", "poiseuille"), 0.6)
    d.mesh(0.3)
    d.number("tolerance", 0.4)
    d.elements(0.6)
    d.method()


def spheroid_drag(d):
    d.number("aspect")
    if d.chance(0.5):
        d.options["confinement"] = d.between(0.01, 1.02) * d.options["aspect"] ** (1 / 3)
        d.choice("flow", ("none", "poiseuille"))
    d.elements(0.6)
    d.method()


def bodies_in_line(d):
    spheres = d.chance(0.5)
    d.options["kind"] = "sphere" if spheres else "vesicle"
    d.options["count"] = d.rng.choice((1, 2, 2, 3))
    if spheres:
        d.options["distance"] = 2 + 10 ** d.rng.uniform(-4, 1.3)
    else:
        d.vesicle()
        d.number("distance")
    drive = d.rng.choice(("bond", "capillary-number", "unbounded-capillary-number", None))
    if drive == "capillary-number" or (drive != "unbounded-capillary-number" and d.chance(0.3)):
        d.tube(d.options.get("excess-area", 0))
    if drive:
        d.number(drive, signed=True)
    d.elements(0.5)
    d.method()
    if not spheres and d.chance(0.4):
        d.choice("stationary", ("auto", "march", "newton"))
    else:
        d.number("time", 0.6)
    d.number("step-tolerance", 0.1)
    d.number("max-steps", 0.7)


def vesicle_through_constriction(d):
    d.options["excess-area"] = d.between(0.1, 8)
    d.choice("profile", ("constriction", "pore"))
    d.number("throat")
    d.options["wide"] = d.options["throat"] * d.between(1, 3)
    d.number("transition", 0.5)
    if d.options["profile"] == "pore":
        d.number("length", 0.5)
    d.number("flow-rate")
    d.number("tolerance", 0.2)
    d.elements(0.5)
    d.method()
    d.number("max-steps", 0.8)


def tether(d):
    d.options["excess-area"] = d.between(0.05, 8)
    d.options["bond"] = d.between(10, 1e5)
    d.run()


PROGRAMS = ((settling_vesicle, 24), (poiseuille_vesicle, 26), (relaxing_vesicle, 10), (sphere_in_tube, 9),
            (spheroid_drag, 7), (bodies_in_line, 13), (vesicle_through_constriction, 7), (tether, 4))


def text(value):
    return value if isinstance(value, str) else str(value) if isinstance(value, int) else f"{value:.7g}"


class Case:
    """Case `index` of the sweep `seed`: nothing else is needed to draw it. Six in thirty indices are two triples with
    one option at half, once and twice an end of its range."""

    def __init__(self, seed, index, cheap=False):
        self.seed, self.index = seed, index
        triple = index % 30 < 6
        rng = random.Random(f"{seed}:{index - index % 3 if triple else index}")
        drawing = Drawing(rng)
        program = rng.choices([p for p, _ in PROGRAMS], [w for _, w in PROGRAMS])[0]
        program(drawing)
        self.program = program.__name__
        if self.program == "tether":
            self.program = rng.choice(("tether", "pearling"))
        self.options = drawing.options
        extreme = sorted(RANGES.keys() & self.options.keys())
        if triple and extreme:
            name = rng.choice(extreme)
            sign = math.copysign(1, self.options[name])
            self.options[name] = sign * rng.choice(RANGES[name]) * 2.0 ** (index % 3 - 1)
        if cheap:
            self.make_cheap()
        for name in WHOLE & self.options.keys():
            self.options[name] = round(self.options[name])
        self.second = rng.random() < 0.1

    def make_cheap(self):
        if self.program != "relaxing_vesicle" and self.program.endswith("vesicle") or self.program in ("tether", "pearling"):
            self.options["max-steps"] = CHEAP["max-steps"]
        if "max-steps" in self.options or self.program == "vesicle_through_constriction":
            self.options["max-steps"] = min(CHEAP["max-steps"], self.options.get("max-steps", 12))
        self.options["elements"] = min(CHEAP["elements"], self.options.get("elements", 40))

    def other(self, summary):
        """The options of a second run whose result must be the same: another discretisation, or half as many elements
        again."""
        options = dict(self.options)
        kinds = [k for k in ("spectral", "adaptive", "linear") if k != summary.get("discretization")]
        rng = random.Random(f"{self.seed}:{self.index}:second")
        if rng.random() < 0.5:
            options["discretization"] = rng.choice(kinds[:1] if "preset-accuracy" in options else kinds)
            options.pop("elements", None)
        else:
            elements = summary.get("elements") or summary["bodies"][0]["elements"]
            options["elements"] = round(1.5 * elements) + 1
        return options


class Runner:
    def __init__(self, arguments):
        self.programs = pathlib.Path(arguments.programs).resolve()
        self.seconds = arguments.seconds
        self.work = pathlib.Path(tempfile.mkdtemp(prefix="limits"))

    def command(self, program, options):
        words = [program]
        for name, value in options.items():
            words += ["--" + name, text(value)]
        return words

    def execute(self, words, directory):
        """Exit code (negative: a signal), whether time was over, seconds of processor time, last line on standard
        error. Programs are asked to end first, as they do on an interrupt; those that do not are killed."""
        limit = math.ceil(self.seconds)

        def confine():
            signal.signal(signal.SIGINT, signal.SIG_DFL)  # a shell's background jobs ignore it
            resource.setrlimit(resource.RLIMIT_CPU, (limit + 10, limit + 12))
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        with open(directory / "stderr", "w+b") as errors:
            process = subprocess.Popen([str(self.programs / words[0]), *words[1:], "--out", str(directory / "out")],
                                       stdout=subprocess.DEVNULL, stderr=errors, preexec_fn=confine)
            begin, asked, pause = time.monotonic(), None, 0.002
            while True:
                pid, status, usage = os.wait4(process.pid, os.WNOHANG)
                if pid:
                    process.returncode = os.waitstatus_to_exitcode(status)
                    break
                now = time.monotonic()
                if asked is None and (used_seconds(process.pid) > self.seconds or now - begin > 20 * self.seconds):
                    process.send_signal(signal.SIGINT)
                    asked = now
                elif asked and (used_seconds(process.pid) > 2 * self.seconds + 1 or now - asked > 20 * self.seconds):
                    process.kill()
                time.sleep(pause)
                pause = min(0.1, 1.5 * pause)
            errors.seek(0)
            message = errors.read().decode(errors="replace").strip()
        return process.returncode, asked is not None, usage.ru_utime + usage.ru_stime, message

    def judge(self, case, words, directory):
        """A row of the table, without the second run's, and the summary of a run whose result is reported as good."""
        code, over, seconds, message = self.execute(words, directory)
        row = {"seed": case.seed, "index": case.index, "seconds": f"{seconds:.2f}", "message": message.split("\n")[-1],
               "command": shlex.join(words)}
        summary, trouble = read_results(directory / "out")
        for key in ("velocity", "error_estimate", "error_met", "elements", "steps"):
            row[key] = summary.get(key, "") if summary else ""
        good = None
        if code < 0 and over:
            row["outcome"] = "HANG"
        elif code < 0:
            row["outcome"], row["message"] = "CRASH", f"{signal.Signals(-code).name} {message}"
        elif code == 130:
            row["outcome"] = "time over"
        elif code == 2:
            row["outcome"] = "refused"
        elif code not in (0, 3):
            row["outcome"] = "CRASH"
        elif trouble:
            row["outcome"], row["message"] = "NON-FINITE", trouble
        elif code == 3:
            row["outcome"] = "failure"
        elif summary is None:
            row["outcome"], row["message"] = "CRASH", "no summary.json"
        else:
            row["outcome"] = ending(case.options, summary)
            if summary.get("error_met"):
                good = summary
                wrong = referee.complaints(case.program, case.options, summary, directory / "out")
                if wrong:
                    row["outcome"], row["message"] = "WRONG", "; ".join(wrong)
        return row, good

    def __call__(self, case):
        directory = pathlib.Path(tempfile.mkdtemp(dir=self.work))
        try:
            first = directory / "first"
            first.mkdir()
            row, good = self.judge(case, self.command(case.program, case.options), first)
            if good and case.second and row["outcome"] in ("stationary", "end time"):
                second = directory / "second"
                second.mkdir()
                words = self.command(case.program, case.other(good))
                other, finer = self.judge(case, words, second)
                row["second_command"], row["second_seconds"] = other["command"], other["seconds"]
                difference = finer and other["outcome"] == row["outcome"] and referee.difference(good, finer)
                if difference:
                    row["outcome"], row["message"] = "DISAGREES", difference
            return row
        finally:
            shutil.rmtree(directory)


def used_seconds(pid):
    try:
        with open(f"/proc/{pid}/stat") as file:
            fields = file.read().rsplit(")", 1)[1].split()
    except OSError:
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def read_results(directory):
    """Summary, and where something that is not finite is."""
    try:
        with open(directory / "summary.json") as file:
            summary = json.load(file)
    except FileNotFoundError:
        return None, None
    places = referee.not_finite(summary)
    # Numbers that are no numbers are written as null; an estimate may be missing.
    if places:
        return summary, "summary.json: " + ", ".join(places)
    for table in sorted(directory.glob("*.csv")):
        content = table.read_text()
        found = re.search(r"(?im)(?:^|,)[-+]?(?:nan|inf)", content)
        if found:
            line = content.count("\n", 0, found.end()) + 1
            column = content[: found.end()].rsplit("\n", 1)[-1].count(",")
            header = content.split("\n", 1)[0].split(",")
            return summary, f"{table.name}:{line}: {header[column]} is {found.group().strip(',')}"
    return summary, None


def ending(options, summary):
    if summary.get("stationary") or summary.get("passed"):
        return "stationary"
    if "max-steps" in options and summary.get("steps", 0) >= options["max-steps"]:
        return "step limit"
    return "end time"


def run(arguments):
    path = pathlib.Path(arguments.results)
    path.parent.mkdir(parents=True, exist_ok=True)
    if arguments.afresh:
        path.unlink(missing_ok=True)
    done = {(int(r["seed"]), int(r["index"])) for r in rows(path)} if path.exists() else set()
    cases = [Case(arguments.seed, i, arguments.cheap) for i in range(arguments.first, arguments.first + arguments.cases)
             if (arguments.seed, i) not in done]
    print(f"seed {arguments.seed}, {len(cases)} cases to run, results in {path}", flush=True)
    runner, counts = Runner(arguments), collections.Counter()
    new = not path.exists()
    stop = time.monotonic() + arguments.minutes * 60
    lock = threading.Lock()
    try:
        with open(path, "a", newline="") as file, concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
            table = csv.DictWriter(file, FIELDS)
            if new:
                table.writeheader()

            def one(case):
                if time.monotonic() > stop:
                    return
                row = runner(case)
                with lock:
                    table.writerow(row)
                    file.flush()
                    counts[row["outcome"]] += 1
                    if row["outcome"] in TROUBLE:
                        print(f"{row['outcome']} ({row['message']}): {row['command']}", flush=True)

            for done in [pool.submit(one, case) for case in cases]:
                done.result()
    finally:
        shutil.rmtree(runner.work)
    print(", ".join(f"{count} {outcome}" for outcome, count in counts.most_common()))
    if not sum(counts.values()) and cases:
        return 1
    return 1 if any(counts[kind] for kind in TROUBLE if kind not in arguments.allow) else 0


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def kind_of(row):
    """Outcome, program and message without numbers."""
    message = row["message"].split(": ", 1)[-1] if row["outcome"] in ("failure", "refused", "CRASH") else row["message"]
    message = re.sub(r"[-+]?\d+(\.\d*)?(e[-+]?\d+)?", "#", message)
    message = re.sub(r"(?<=# )[\w-]+ = \S+?(?=:)", "...", message)
    return row["outcome"], message[:110]


def report(arguments):
    table = rows(arguments.results)
    programs = sorted({r["command"].split()[0] for r in table})
    outcomes = [o for o, _ in collections.Counter(r["outcome"] for r in table).most_common()]
    print("| program | cases | " + " | ".join(outcomes) + " |\n|" + "---|" * (len(outcomes) + 2))
    for program in programs + [""]:
        mine = [r for r in table if r["command"].split()[0] == program or not program]
        counts = collections.Counter(r["outcome"] for r in mine)
        print(f"| {program or 'all'} | {len(mine)} | " + " | ".join(str(counts[o]) for o in outcomes) + " |")
    for title, chosen in (("trouble", [k for k in TROUBLE]), ("reported causes", ["failure"]), ("refusals", ["refused"]),
                          ("time over", ["time over"])):
        groups = collections.defaultdict(list)
        for row in table:
            if row["outcome"] in chosen:
                groups[kind_of(row)].append(row)
        if not groups:
            continue
        print(f"\n## {title}\n\n| kind | cases | message | shortest command line |\n|---|---|---|---|")
        for (outcome, message), group in sorted(groups.items(), key=lambda g: (chosen.index(g[0][0]), -len(g[1]))):
            shortest = min(group, key=lambda r: len(r["command"]))
            print(f"| {outcome} | {len(group)} | {message} | `{shortest['command']}` |")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="what", required=True)
    runs = commands.add_parser("run", help="draw scenes and run them")
    runs.add_argument("--programs", default="build/examples", help="directory of the programs (default: build/examples)")
    runs.add_argument("--cases", type=int, default=1000, help="how many (default: 1000)")
    runs.add_argument("--first", type=int, default=0, metavar="INDEX", help="the first one (default: 0)")
    runs.add_argument("--seconds", type=float, default=20, help="of processor time for a run (default: 20)")
    runs.add_argument("--minutes", type=float, default=1e9, help="start no case after that long")
    runs.add_argument("--allow", nargs="*", default=[], choices=TROUBLE, help="trouble that is no reason to exit with 1")
    runs.add_argument("--afresh", action="store_true", help="remove the table first")
    runs.add_argument("--jobs", type=int, default=1, help="runs at a time (default: 1)")
    runs.add_argument("--cheap", action="store_true", help="with few elements and steps")
    show = commands.add_parser("show", help="the command line of a case")
    show.add_argument("index", type=int)
    commands.add_parser("report", help="tables of the outcomes")
    drawing = commands.add_parser("draw", help="maps of the outcomes")
    drawing.add_argument("--pictures", default="docs/limits", help="directory for the pictures (default: docs/limits)")
    for command in (runs, show):
        command.add_argument("--seed", type=int, default=1, help="of the random numbers (default: 1)")
    for command in (runs, commands.choices["report"], drawing):
        command.add_argument("--results", default="build/limits/sweep.csv",
                             help="the table (default: build/limits/sweep.csv)")
    arguments = parser.parse_args()
    if arguments.what == "run":
        return run(arguments)
    if arguments.what == "show":
        case = Case(arguments.seed, arguments.index)
        print(shlex.join(Runner.command(None, case.program, case.options)))
        return 0
    if arguments.what == "report":
        return report(arguments)
    from draw import draw  # needs matplotlib

    return draw(rows(arguments.results), pathlib.Path(arguments.pictures))


if __name__ == "__main__":
    sys.exit(main())
