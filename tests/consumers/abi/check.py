"""The binary interface of the library, against lists: what it exports, and the sizes of its data.

symbols.csv  what programs that are linked against libCEED may ask for, with the sizes of data, which they have copied
left_out.txt those of them that are not promised, and why
missing.txt  those of them that are promised and not there yet; it shrinks
own.txt      what only this library exports

    exported = symbols.csv - left_out.txt - missing.txt + own.txt

Every difference is printed with the line to delete or to add.
"""

import argparse
import csv
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent


def listed(name):
    lines = [line.split("#")[0].strip() for line in (HERE / name).read_text().splitlines()]
    symbols = [line for line in lines if line]
    for symbol in symbols:
        if symbols.count(symbol) > 1:
            sys.exit(f"{name} has {symbol} twice")
    return set(symbols)


def promised():
    """Symbol -> size of its data, or None for a function."""
    with open(HERE / "symbols.csv", newline="") as file:
        return {row["symbol"]: int(row["size_bytes"]) if row["kind"] == "data" else None for row in csv.DictReader(file)}


def exported(library):
    """Symbol -> (is it data, its size)."""
    text = subprocess.run(["readelf", "-sW", "--dyn-syms", library], check=True, capture_output=True, text=True).stdout
    found = {}
    for line in text.splitlines():
        fields = line.split()
        if len(fields) < 8 or not fields[0].rstrip(":").isdigit():
            continue
        _, _, size, kind, binding, visibility, section, name = fields[:8]
        if binding == "LOCAL" or section == "UND" or visibility in ("HIDDEN", "INTERNAL"):
            continue
        found[name.split("@")[0]] = (kind == "OBJECT", int(size, 0))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("library", help="libceed.so")
    library = parser.parse_args().library
    symbols, left_out, missing, own = promised(), listed("left_out.txt"), listed("missing.txt"), listed("own.txt")
    found = exported(library)
    complaints = []

    def complain(names, text):
        complaints.extend(text.format(name) for name in sorted(names))

    complain(left_out - symbols.keys(), "left_out.txt: {0} is not in symbols.csv")
    complain(missing - symbols.keys(), "missing.txt: {0} is not in symbols.csv")
    complain(own & symbols.keys(), "own.txt: {0} is in symbols.csv too")
    complain(left_out & missing, "{0} is in left_out.txt and in missing.txt")
    complain(missing & found.keys(), "NEW: {0} is there now; delete its line in missing.txt")
    complain(left_out & found.keys(), "NEW: {0} is there now; delete its line in left_out.txt")
    complain(own - found.keys(), "GONE: {0}, which own.txt lists")
    complain(symbols.keys() - left_out - missing - found.keys(), "GONE: {0}, which programs linked against libCEED ask for")
    complain(found.keys() - symbols.keys() - own, "FOREIGN: {0} is exported and in no list; if it should be, add it to own.txt")
    for name, size in sorted(symbols.items()):
        if name not in found:
            continue
        is_data, got = found[name]
        if is_data != (size is not None):
            complaints.append(f"{name} is {'data' if is_data else 'a function'}; expected the other")
        elif is_data and got != size:
            complaints.append(f"{name} has {got} bytes; programs linked against libCEED have copied {size}")
    print("\n".join(complaints))
    there = len(symbols.keys() - left_out & found.keys())
    print(f"{len(symbols)} symbols of libCEED's library: {there} there, {len(missing)} missing, {len(left_out)} left out; "
          f"{len(own)} of our own; {sum(size is not None for size in symbols.values())} with sizes")
    if not found or not symbols:
        sys.exit("nothing was compared")
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main()
