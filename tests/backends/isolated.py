"""Objects compiled for an instruction set define symbols in its own namespace alone: the linker keeps one copy of what
several objects define, and must not keep that of a processor which the machine does not have.

usage: isolated.py ISA OBJECT..."""

import subprocess
import sys

isa, objects = sys.argv[1], sys.argv[2:]
foreign, count = [], 0
for path in objects:
    text = subprocess.run(["nm", "-C", "--defined-only", path], check=True, capture_output=True, text=True).stdout
    for line in text.splitlines():
        _, kind, name = line.split(maxsplit=2)
        count += 1
        # Lower case: local to the object, but for u, a unique global.
        if (kind.isupper() or kind == "u") and f"hg::host::{isa}::" not in name:
            foreign.append(f"{path}: {kind} {name}")
print("\n".join(foreign))
print(f"{count} symbols, {len(foreign)} outside of hg::host::{isa}")
sys.exit(1 if foreign or count < 10 else 0)
