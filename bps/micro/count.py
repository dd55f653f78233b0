#!/usr/bin/env python3
"""Counts the instructions of each kernel of backends/host, by callgrind: the same numbers in every run of one program.

Writes JSON in the shape of Google Benchmark's, for compare.py: a benchmark for each case, with `instructions`, and `floor`,
the instructions that the kernel cannot do without over those that it took. valgrind runs the instruction sets that it
knows; those of this machine that it does not know are named.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile


def fail(message):
    sys.exit(f"count.py: {message}")


def run(command):
    try:
        finished = subprocess.run(command, capture_output=True, text=True)
    except OSError as error:
        fail(f"cannot run {command[0]}: {error.strerror}")
    if finished.returncode:
        fail(f"{' '.join(map(str, command))}: exit status {finished.returncode}\n{finished.stderr.strip()}")
    return finished.stdout


def cases(program, pattern):
    """Name -> (instructions of the floor, flops, bytes), of all instruction sets of this machine."""
    lines = [line.split("\t") for line in run([program, "--list", pattern]).splitlines()]
    return {name: tuple(map(float, numbers)) for name, *numbers in lines}


def counts(program, pattern, valgrind):
    """Name -> instructions of one call."""
    found = {}
    with tempfile.TemporaryDirectory(prefix="honeyguide-count-") as folder:
        run([valgrind, "--tool=callgrind", "--collect-atstart=no",
             f"--callgrind-out-file={folder}/counts", program, pattern])
        # Each file that a client asked for says so, and has a line with the sum.
        for file in pathlib.Path(folder).iterdir():
            text = file.read_text()
            name = re.search(r"^desc: Trigger: Client Request: (.*)$", text, re.MULTILINE)
            total = re.search(r"^(?:totals|summary): (\d+)$", text, re.MULTILINE)
            if name and total:
                found[name.group(1).strip()] = int(total.group(1))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="bps-micro-count")
    parser.add_argument("--out", default="count.json", help="the file to write (default: %(default)s)")
    parser.add_argument("--filter", default="", metavar="REGEX", help="only cases in whose names it is found")
    parser.add_argument("--valgrind", default="valgrind", help="the program (default: %(default)s)")
    args = parser.parse_args()

    known = cases(args.program, args.filter)
    if not known:
        fail(f"no case has '{args.filter}' in its name; '{args.program} --list' prints all")
    counted = counts(args.program, args.filter, args.valgrind)
    sets = {name: any(case.startswith(name + "/") for case in counted)
            for name in dict.fromkeys(case.split("/")[0] for case in known)}
    missing = [case for case in known if sets[case.split("/")[0]] and not counted.get(case)]
    if missing or not counted:
        fail("callgrind left no count of " + ", ".join(missing or known))

    version = run([args.valgrind, "--version"]).strip()
    left_out = [name for name, is_counted in sets.items() if not is_counted]
    result = {
        "context": {
            "executable": args.program,
            "counted_by": version,
            "instruction_sets": [name for name in sets if name not in left_out],
            "instruction_sets_not_counted": left_out,
        },
        "benchmarks": [{
            "name": case,
            "run_name": case,
            "run_type": "iteration",
            "iterations": 1,
            "instructions": counted[case],
            "flops": flops,
            "bytes": read_and_written,
            "floor": floor / counted[case],
        } for case, (floor, flops, read_and_written) in known.items() if case in counted],
    }
    partial = args.out + ".partial"
    try:
        with open(partial, "w") as file:
            json.dump(result, file, indent=2)
            file.write("\n")
        os.replace(partial, args.out)
    except OSError as error:
        fail(f"cannot write {args.out}: {error.strerror}")

    width = max(map(len, counted))
    print(f"{'':{width}}  instructions  floor")
    for case in result["benchmarks"]:
        print(f"{case['name']:{width}}  {case['instructions']:12}  {case['floor']:5.2f}")
    for name in left_out:
        print(f"not counted: {name}, which this machine has and {version} does not know")


if __name__ == "__main__":
    main()
