#!/usr/bin/env python3
"""Compares two JSON files of benchmarks, those of Google Benchmark or of count.py: the ratio after / before of each one.

Times are the CPU times of Google Benchmark, the least of repetitions; counts are compared where both files have them. A
ratio below 1 is an improvement. What is in one file only is listed.
"""

import argparse
import json
import math
import pathlib
import sys

UNITS = {"ns": 1, "us": 1e3, "ms": 1e6, "s": 1e9}


def fail(message):
    print(f"compare.py: {message}", file=sys.stderr)
    sys.exit(2)


def is_positive(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value) and value > 0


def read(path):
    """(quantity, name -> value, names of benchmarks that failed)"""
    try:
        text = pathlib.Path(path).read_text()
    except OSError as error:
        fail(f"{path}: {error.strerror}")
    except UnicodeDecodeError:
        fail(f"{path}: not a text file")
    try:
        content = json.loads(text)
    except json.JSONDecodeError as error:
        fail(f"{path}: not a JSON file: {error}")
    entries = content.get("benchmarks") if isinstance(content, dict) else None
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        fail(f"{path}: expected an object with a list 'benchmarks' of objects, as Google Benchmark writes it")

    quantities, values, failed = set(), {}, []
    for number, entry in enumerate(entries):
        name = entry.get("run_name", entry.get("name"))
        if not isinstance(name, str):
            fail(f"{path}: benchmark {number} has no name")
        if entry.get("run_type") == "aggregate":
            continue
        if entry.get("error_occurred"):
            failed.append(name)
            continue
        quantity = "instructions" if "instructions" in entry else "cpu_time"
        value = entry.get(quantity)
        if not is_positive(value):
            fail(f"{path}: '{name}': expected a positive number '{quantity}', found {json.dumps(value)}")
        if quantity == "cpu_time":
            unit = entry.get("time_unit", "ns")
            if unit not in UNITS:
                fail(f"{path}: '{name}': time_unit is {json.dumps(unit)}; expected one of {', '.join(UNITS)}")
            value *= UNITS[unit]
        quantities.add(quantity)
        values[name] = min(value, values.get(name, math.inf))
    if not values:
        fail(f"{path}: has no benchmark that ran")
    if len(quantities) > 1:
        fail(f"{path}: has both times and counts of instructions")
    return quantities.pop(), values, failed


def shown(quantity, value):
    if quantity == "instructions":
        return f"{value:.0f}"
    for unit, factor in reversed(UNITS.items()):
        if value >= factor or unit == "ns":
            return f"{value / factor:.4g} {unit}"


def compare(before_path, after_path):
    quantity, before, before_failed = read(before_path)
    other, after, after_failed = read(after_path)
    if quantity != other:
        fail(f"{before_path} has {quantity}, {after_path} has {other}: not comparable")
    common = [name for name in before if name in after]
    if not common:
        fail(f"{before_path} and {after_path} have no benchmark in common")

    width = max(len(name) for name in [*common, "geometric mean"])
    print(f"{quantity:{width}}  {'before':>12}  {'after':>12}  after / before")
    logarithms = 0
    for name in common:
        ratio = after[name] / before[name]
        logarithms += math.log(ratio)
        print(f"{name:{width}}  {shown(quantity, before[name]):>12}  {shown(quantity, after[name]):>12}  {ratio:.3f}")
    mean = math.exp(logarithms / len(common))
    print(f"{'geometric mean':{width}}  {'':12}  {'':12}  {mean:.3f}  ({len(common)} benchmarks)")
    for path, here, there in ((before_path, before, after), (after_path, after, before)):
        for name in here:
            if name not in there:
                print(f"only in {path}: {name}")
    for path, names in ((before_path, before_failed), (after_path, after_failed)):
        for name in names:
            print(f"failed in {path}: {name}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", metavar="before.json after.json")
    parser.add_argument("--folder", type=pathlib.Path,
                        help="compare micro.json and count.json there with those of the run before: *-before.json")
    args = parser.parse_args()
    if args.folder is None:
        if len(args.files) != 2:
            fail(f"expected two files, before.json and after.json, found {len(args.files)}")
        compare(*args.files)
        return
    if args.files:
        fail("expected two files or --folder, found both")
    pairs = [(args.folder / f"{kind}-before.json", args.folder / f"{kind}.json") for kind in ("micro", "count")]
    pairs = [pair for pair in pairs if pair[0].exists() and pair[1].exists()]
    if not pairs:
        fail(f"{args.folder}: expected micro.json or count.json and the one of the run before, *-before.json: build the "
             "target bench-micro or bench-count twice")
    for pair in pairs:
        compare(*pair)


if __name__ == "__main__":
    main()
