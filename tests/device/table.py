"""A short table of what run.sh measured: million degrees of freedom or points a second, and the part of the copies' rate."""
import json
import pathlib
import sys

folder = pathlib.Path(sys.argv[1])
bandwidth = json.loads((folder / "bandwidth.json").read_text())
copies = bandwidth["gb_per_s"]
at_points = bandwidth["points"]["gb_per_s"]
print(f"copies: {copies:.0f} GB/s, by an operator whose fields are all at points {at_points:.0f} GB/s ({at_points / copies:.0%});")
print("in brackets compulsory bytes a second over that of copies")
for path in sorted(folder.glob("bps_*.json")) + sorted(folder.glob("points_*.json")):
    records = json.loads(path.read_text())
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
