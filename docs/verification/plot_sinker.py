#!/usr/bin/env python3
"""Draws force against displacement of the sinker, runs beside published curves, and prints their differences.

Each run is METHOD:ELEMENTS:FILE or mpm:ELEMENTSxPOINTS:FILE, for example mpm:5:sinker-mpm.csv or mpm:10x64:more.csv, where
FILE is what honeyguide wrote with -ts_monitor_quantities. The published points were read off printed figures, with an error of about 0.002 m.

The published mean of a finite element run is that over the nodes of the sinker, not over its volume, which is 8 % more.
So that it can be compared, let the run follow those nodes: honeyguide ... -probe $(plot_sinker.py --print-probes ELEMENTS)
"""

import argparse
import csv
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
LOAD_STEPS = 20
CURVES = {"sinker_center": ("centre of the sinker", "displacement_probe0"),
          "full_sinker": ("mean of the sinker", "mean_displacement_sinker")}
COLOURS = {"fem": "#1f6f8b", "mpm": "#d98324"}
LINES = {5: "-", 10: "--", 15: ":"}
MARKERS = {5: "o", 10: "s", 15: "^"}


class Run:
    """One run: at each time the force on the sinker, and the downward displacements."""

    def __init__(self, argument):
        parts = argument.split(":", 2)
        size = re.fullmatch(r"(\d+)(?:x(\d+))?", parts[1]) if len(parts) == 3 else None
        if not size or parts[0] not in COLOURS:
            sys.exit(f"'{argument}': expected fem:ELEMENTS:FILE, mpm:ELEMENTS:FILE or mpm:ELEMENTSxPOINTS:FILE")
        self.method, self.elements, self.points, self.file = parts[0], int(size[1]), size[2], parts[2]
        with open(self.file, newline="") as lines:
            rows = list(csv.DictReader(lines))
        if not rows:
            sys.exit(f"{self.file}: no steps")
        self.load_step, self.force = [], []
        self.down = {curve: [] for curve in CURVES}
        nodes = sum(re.fullmatch(r"displacement_probe\d+_x", column) is not None for column in rows[0]) - 1
        for row in rows:
            force = self.vector(row, "body_force_sinker")
            size = sum(f * f for f in force) ** 0.5
            if size == 0:
                continue  # the unloaded start: no direction is downward yet
            self.load_step.append(float(row["time"]) * LOAD_STEPS)
            self.force.append(size)
            for curve, (_, column) in CURVES.items():
                displacement = self.vector(row, column)
                self.down[curve].append(sum(u * f for u, f in zip(displacement, force)) / size)
            if nodes:
                followed = [self.vector(row, f"displacement_probe{node}") for node in range(1, nodes + 1)]
                self.down["full_sinker"][-1] = sum(u * f for node in followed for u, f in zip(node, force)) / size / nodes
        if not self.load_step:
            sys.exit(f"{self.file}: no step has a load on the sinker")

    def vector(self, row, stem):
        try:
            return [float(row[f"{stem}_{axis}"]) for axis in "xyz"]
        except KeyError as missing:
            sys.exit(f"{self.file}: no column {missing}: run with one -probe and a region named sinker")

    def at(self, step, values):
        """A value at a load step, or None where the run has none."""
        for known, value in zip(self.load_step, values):
            if abs(known - step) < 1e-6:
                return value
        return None

    def label(self):
        """With the points in a cell where the run names them."""
        return f"{self.method.upper()} {self.elements}³" + (f", {self.points} points" if self.points else "")


def probes(elements):
    """The centre of the sinker, then its nodes on a mesh of order 2, as honeyguide's -probe wants them."""
    first, last = 4 * elements // 5, 6 * elements // 5
    line = [node / (2 * elements) for node in range(first, last + 1)]
    places = [(0.5, 0.5, 0.5)] + [(x, y, z) for z in line for y in line for x in line]
    return ",".join(f"{coordinate:.12g}" for place in places for coordinate in place)


def published_points(file):
    points = {}
    with open(file, newline="") as lines:
        for row in csv.DictReader(lines):
            key = row["curve"], row["method"], int(row["elements_per_side"])
            points.setdefault(key, []).append((int(row["step"]), float(row["downward_displacement_m"])))
    return points


def print_table(runs, published):
    """Differences in percent of the published value, at every fourth step and in the worst one."""
    shown = range(4, LOAD_STEPS + 1, 4)
    print("| run | curve | " + " | ".join(f"step {step}" for step in shown) + " | steps compared | largest difference |")
    print("|---" * (len(shown) + 4) + "|")
    for run in runs:
        for curve, (name, _) in CURVES.items():
            points = dict(published.get((curve, run.method, run.elements), []))
            cells, worst, compared = [], (0, 0.0), 0
            for step in range(1, LOAD_STEPS + 1):
                ours, theirs = run.at(step, run.down[curve]), points.get(step)
                both = ours is not None and theirs is not None
                if both:
                    difference = 100 * (ours / theirs - 1)
                    compared += 1
                    worst = max(worst, (step, difference), key=lambda entry: abs(entry[1]))
                if step in shown:
                    cells.append("–" if ours is None else f"{ours:.4f} m" + (f" ({difference:+.1f} %)" if both else ""))
            last = f"{worst[1]:+.1f} % at step {worst[0]}" if compared else "–"
            print(f"| {run.label()} | {name} | " + " | ".join(cells) + f" | {compared} | {last} |")


def draw_points(axis, file):
    """Where the points of the middle layer are; those of the first region, the sinker, in one colour."""
    import h5py

    with h5py.File(file, "r") as data:
        x, displacement, region = data["x"][:], data["displacement"][:], data["region"][:]
    layer = abs((x - displacement)[:, 1] - 0.5) < 0.51 / len(x) ** (1 / 3)
    foam, sinker = layer & (region != 0), layer & (region == 0)
    drawn = axis.scatter(x[foam, 0], x[foam, 2], c=-displacement[foam, 2], s=16, cmap="YlGnBu",
                         vmin=-0.15, vmax=0.4, linewidths=0)
    axis.scatter(x[sinker, 0], x[sinker, 2], c="#7a3b12", s=18, linewidths=0, label="sinker")
    axis.set(title="MPM: points of the middle layer", xlabel="x [m]", ylabel="z [m]", xlim=(0, 1), ylim=(0, 1),
             aspect="equal")
    axis.grid(False)
    axis.legend(loc="upper right", fontsize=8)
    bar = axis.figure.colorbar(drawn, ax=axis, label="downward displacement of the foam [m]", shrink=0.85)
    bar.ax.set_ylim(0, 0.4)  # the paler end of the colours is for paper


def draw(runs, published, points, output):
    try:
        import matplotlib
    except ImportError:
        sys.exit(f"{sys.executable} has no matplotlib; on Debian: apt-get install python3-matplotlib, and use /usr/bin/python3")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    pyplot.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
                            "grid.alpha": 0.25, "figure.constrained_layout.use": True})
    panels = len(CURVES) + bool(points)
    figure, axes = pyplot.subplots(1, panels, figsize=(3.9 * panels, 3.5))
    if points:
        draw_points(axes[0], points)
    for axis, (curve, (name, _)) in zip(axes[-len(CURVES):], CURVES.items()):
        shown = set()
        for run in runs:
            colour = COLOURS[run.method]
            giga = [force / 1e9 for force in run.force]
            axis.plot([0, *run.down[curve]], [0, *giga], LINES.get(run.elements, "-."), color=colour, label=run.label())
            theirs = published.get((curve, run.method, run.elements), [])
            if theirs and (run.method, run.elements) not in shown:
                shown.add((run.method, run.elements))
                # The load grows in equal steps, so the force of a step follows from the first one.
                unit = giga[0] / run.load_step[0]
                axis.plot([down for _, down in theirs], [step * unit for step, _ in theirs], linestyle="none",
                          marker=MARKERS.get(run.elements, "D"), markersize=4, markerfacecolor="none", color=colour,
                          label=f"published {run.method.upper()} {run.elements}³")
        axis.set(title="Force on the sinker", xlabel=f"downward displacement, {name} [m]", ylabel="force [GN]")
        axis.legend(frameon=False, fontsize=8)
    figure.savefig(output, dpi=110)
    print(f"wrote {output}", file=sys.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="*", metavar="METHOD:ELEMENTS:FILE")
    parser.add_argument("--published", type=pathlib.Path, default=HERE / "data" / "sinker_published.csv")
    parser.add_argument("--points", help="HDF5 file of the points of a run, drawn beside the curves")
    parser.add_argument("--output", default="sinker.png", help="picture to write (default: sinker.png)")
    parser.add_argument("--no-plot", action="store_true", help="print the table only")
    parser.add_argument("--print-probes", type=int, metavar="ELEMENTS", help="print what -probe is to be, and end")
    args = parser.parse_args()
    if args.print_probes:
        if args.print_probes % 5:
            sys.exit(f"--print-probes {args.print_probes}: expected a multiple of 5, so that cells fit the sinker")
        print(probes(args.print_probes))
        return
    if not args.runs:
        parser.error("no runs")
    runs = [Run(argument) for argument in args.runs]
    published = published_points(args.published)
    print_table(runs, published)
    if not args.no_plot:
        draw(runs, published, args.points, args.output)


if __name__ == "__main__":
    main()
