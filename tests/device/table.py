"""A short table of what run.sh measured: million degrees of freedom or points a second, and the part of the copies' rate."""
import json
import pathlib
import sys

folder = pathlib.Path(sys.argv[1])


def read(path):
    """What a file holds; nothing where its program was stopped while it wrote it."""
    try:
        return json.loads(path.read_text())
    except (OSError, json.JSONDecodeError):
        print(f"{path} cannot be read")
        return None


copies = None
for path in sorted(folder.glob("bandwidth_*.json")):
    rates = read(path)
    if not rates:
        continue
    copies = max(copies or 0, rates["gb_per_s"])
    own, stored = rates["gb_per_s"], rates["points"]["gb_per_s"]
    print(f"{rates['ceed']}: copies {own:.0f} GB/s, where all fields are at points {stored:.0f} GB/s ({stored / own:.0%})")
if copies is None:
    sys.exit("there is no rate of copies")
print("in brackets compulsory bytes a second over that of copies")
for path in sorted(folder.glob("bps_*.json")) + sorted(folder.glob("points_*.json")):
    records = read(path)
    if not records:
        continue
    at_points = path.name.startswith("points_")
    unit = "Mpoints/s" if at_points else "MDoF/s"
    print(f"\n{records[0]['ceed']}, {records[0]['dofs'] / 1e6:.1f} million DoFs, {unit}")
    rows = {}
    for r in records:
        row = r["problem"] + (f" {r['points_per_cell']} points" if at_points else "")
        rate = r["mpoints_per_s"] if at_points else r["mdofs_per_s"]
        rows.setdefault(row, {})[r["degree"]] = f"{rate:.0f} ({r['gb_per_s'] / copies:.0%})"
    degrees = sorted({r["degree"] for r in records})
    print(f"{'':14}" + "".join(f"{'p = ' + str(p):>14}" for p in degrees))
    for row, cells in rows.items():
        print(f"{row:14}" + "".join(f"{cells.get(p, '-'):>14}" for p in degrees))
