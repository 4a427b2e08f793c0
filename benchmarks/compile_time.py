#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compile times as multiples of that of a program with one Eigen LU solve (docs/compile_time.md).

Processor seconds of the compiler, so that the load of the machine matters little. The reference is compiled anew
before each program: other load slows memory, too, and the ratio is taken within a minute.

    benchmarks/compile_time.py                    minimal.cpp, alone and with axistokes::compiled
    benchmarks/compile_time.py --library          the sources of axistokes::compiled, too
    benchmarks/compile_time.py --examples         every source file of the examples, too
    benchmarks/compile_time.py --source OTHER     another checkout
"""

import argparse
import os
import pathlib
import resource
import shlex
import subprocess
import sys
import tempfile

REFERENCE = """#include <Eigen/Dense>
#include <iostream>

int main() {
    const Eigen::MatrixXd a = Eigen::MatrixXd::Random(50, 50);
    const Eigen::VectorXd b = Eigen::VectorXd::Random(50);
    const Eigen::VectorXd x = a.partialPivLu().solve(b);
    std::cout << (a * x - b).norm() << '\\n';
}
"""


def processor_seconds(command):
    """User and system time of the command and its children."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--compiler", default=os.environ.get("CXX", "g++"))
    parser.add_argument("--flags", default="-O2", help="default: -O2")
    parser.add_argument("--source", type=pathlib.Path, default=root, help="checkout to measure; default: this one")
    parser.add_argument("--include", action="append", default=["/usr/include/eigen3"],
                        help="further directory of headers (repeatable)")
    parser.add_argument("--repeat", type=int, default=1, help="take the least of so many ratios")
    parser.add_argument("--library", action="store_true", help="the sources of axistokes::compiled, too")
    parser.add_argument("--examples", action="store_true", help="all sources of the examples, too")
    arguments = parser.parse_args()

    source = arguments.source
    minimal = source / "examples" / "minimal.cpp"
    programs = [("minimal.cpp", minimal, [])]
    library = sorted((source / ".cmake" / "compiled").glob("*.cpp"))
    if library:
        programs.append(("minimal.cpp with axistokes::compiled", minimal, ["-DAXISTOKES_COMPILED"]))
    if arguments.library:
        programs += [(str(p.relative_to(source)), p, []) for p in library]
    if arguments.examples:
        examples = sorted((source / "examples").glob("**/*.cpp"))
        programs += [(str(p.relative_to(source)), p, []) for p in examples if p != minimal]

    command = [arguments.compiler, "-std=c++20", *shlex.split(arguments.flags)]
    for directory in [source / "include", *arguments.include]:
        command += ["-isystem", str(directory)]
    width = max(len(name) for name, _, _ in programs)
    print(f"{'':{width}}    CPU s    LU s   ratio")
    with tempfile.TemporaryDirectory() as work:
        reference = pathlib.Path(work) / "reference.cpp"
        reference.write_text(REFERENCE)
        output = ["-o", str(pathlib.Path(work) / "output.o")]

        def measure(path, definitions):
            return processor_seconds([*command, *definitions, "-c", str(path), *output])

        total = 0.0
        for name, path, definitions in programs:
            runs = [(measure(path, definitions), measure(reference, [])) for _ in range(arguments.repeat)]
            seconds, unit = min(runs, key=lambda run: run[0] / run[1])
            total += seconds
            print(f"{name:{width}} {seconds:8.1f} {unit:7.2f} {seconds / unit:7.2f}", flush=True)
        print(f"{'together':{width}} {total:8.1f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
