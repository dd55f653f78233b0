#!/usr/bin/env python3
"""Linear elasticity with a manufactured solution on the unit cube: errors of FEM and implicit MPM.

    mms_linear.py --honeyguide build/release/bin/honeyguide                    the study: table, CSV and plot
    mms_linear.py --honeyguide build/release/bin/honeyguide --check            assertions on small meshes

The study runs every row of data/mms_linear_published.csv with at most --max-cells cells in each direction, FEM and points
at Gauss locations beside them, and keeps what it has in --csv: started again, it goes on where it stopped.
"""

import argparse
import csv
import math
import pathlib
import re
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
PUBLISHED = HERE / "data" / "mms_linear_published.csv"
NORM = 1e-3 * math.sqrt(14 / 8)  # of the exact solution
NU = 0.25  # the source does not say; this value fits its order-2 curves best
FIELDS = ["method", "order", "placement", "points_per_cell", "cells", "error_mesh", "error_points"]


class Runner:
    def __init__(self, honeyguide, mpiexec=None):
        self.honeyguide, self.mpiexec = honeyguide, mpiexec

    def errors(self, method, order, cells, points=0, placement="uniform", ranks=1, options=()):
        """L2 errors over the mesh and at the points (None for FEM)."""
        command = [] if ranks == 1 else [self.mpiexec, "-n", str(ranks)]
        command += [self.honeyguide, "-method", method, "-order", order, "-dm_plex_box_faces", f"{cells},{cells},{cells}"]
        command += ["-model", "elasticity-linear", "-E", 1, "-nu", NU, "-forcing", "mms", "-bc_mms", "1,2,3,4,5,6"]
        command += ["-ts_dt", 1, "-ts_max_time", 1]
        # One linear solve; the errors of equal weights are large beside what the looser tolerance leaves (1e-5 of them).
        command += ["-snes_type", "ksponly", "-ksp_rtol", 1e-6 if placement == "uniform" and points else 1e-9, *options]
        if method == "mpm":
            # The solution moves the wall outwards by 0.003, and the points next to it; errors are taken before that matters.
            command += ["-mpm_num_points_per_cell", points, "-mpm_point_location_type", placement,
                        "-mpm_point_outside", "project"]
        command = [str(word) for word in command]
        run = subprocess.run(command, capture_output=True, text=True)
        found = re.findall(r"L2 error against the manufactured solution(, at the points)?: (\S+)", run.stdout)
        if run.returncode or not found:
            sys.exit(f"{' '.join(command)}\nended with status {run.returncode}:\n{run.stdout}{run.stderr}")
        values = {bool(where): float(value) for where, value in found}
        return values[False], values.get(True)


def published():
    with open(PUBLISHED) as file:
        for row in csv.DictReader(file):
            yield int(row["order"]), int(row["points_per_cell"]), int(row["elements_per_side"]), float(row["l2_error"])


class Checks:
    def __init__(self):
        self.failed = 0

    def that(self, holds, text):
        print(("ok      " if holds else "FAILED  ") + text, flush=True)
        self.failed += not holds

    def rate(self, what, coarse, fine, ratio, expected, slack):
        rate = math.log(coarse / fine) / math.log(ratio)
        self.that(abs(rate - expected) < slack, f"{what}: rate {rate:.2f}, expected {expected} ± {slack}")


def check(runner):
    checks = Checks()
    for order, coarse in ((1, 8), (2, 5)):
        fem = [runner.errors("fem", order, n)[0] for n in (coarse, 2 * coarse)]
        checks.rate(f"FEM order {order}", *fem, 2, order + 1, 0.15)
        gauss = runner.errors("mpm", order, coarse, (order + 1) ** 3, "gauss")[0]
        checks.that(abs(gauss / fem[0] - 1) < 1e-5, f"order {order}: points at Gauss locations give FEM's error, {gauss:.6e}")
    for points in (8, 27):
        plain = [runner.errors("mpm", 1, n, points)[0] for n in (8, 16)]
        checks.rate(f"MPM order 1, {points} uniform points", *plain, 2, 2, 0.15)

    values = {(o, p, n): e for o, p, n, e in published()}
    for points in (8, 27, 64, 125):
        for cells in (5, 10, 20):
            error, reference = runner.errors("mpm", 2, cells, points)[1], values[2, points, cells]
            checks.that(abs(error / reference - 1) < 0.1,
                        f"MPM order 2, {points} points, {cells}³ cells: {error:.3e}, published {reference:.3e}")
    # The published order-1 errors are those of two cells more in each direction: see mms_linear.md.
    for points, cells in ((8, 6), (8, 10), (8, 20), (27, 8), (1, 10)):
        error, reference = runner.errors("mpm", 1, cells + 2, points)[1], values[1, points, cells]
        checks.that(abs(error / reference - 1) < 0.1, f"MPM order 1, {points} points, {cells + 2}³ cells: {error:.3e}, "
                    f"published for {cells}³ {reference:.3e}")
    # one point in a cell leaves the quadratic space singular: the least-norm solution is zero inside
    error = runner.errors("mpm", 2, 3, 1, options=["-mat_type", "aij", "-pc_type", "svd"])[1]
    checks.that(abs(error / NORM - 1) < 0.01, f"MPM order 2, 1 point: the error is the norm, {error:.4e} of {NORM:.4e}")
    if runner.mpiexec:
        for method, points in (("fem", 0), ("mpm", 27)):
            one, two = (runner.errors(method, 2, 5, points, ranks=ranks)[0] for ranks in (1, 2))
            checks.that(abs(two / one - 1) < 1e-6, f"{method} on 2 ranks: {two:.7e}, on one {one:.7e}")
    print(f"{checks.failed} checks failed")
    return 1 if checks.failed else 0


def study(runner, max_cells, csv_path, plot_path):
    done = {}
    if csv_path.exists():
        with open(csv_path) as file:
            done = {tuple(row[f] for f in FIELDS[:5]): row for row in csv.DictReader(file)}
    wanted = [("mpm", o, "uniform", p, n) for o, p, n, _ in published() if n <= max_cells and (o, p) != (2, 1)]
    sizes = sorted({n for *_, n in wanted})
    wanted += [("mpm", 1, "uniform", p, n + 2) for o, p, n, _ in published() if o == 1 and n <= max_cells]
    wanted += [("fem", order, "", 0, n) for order in (1, 2) for n in sizes]
    wanted += [("mpm", order, "gauss", (order + 1) ** 3, n) for order in (1, 2) for n in sizes if n <= 30]  # as FEM
    wanted = sorted(set(wanted), key=lambda w: (w[4], w))
    with open(csv_path, "a") as file:
        writer = csv.DictWriter(file, FIELDS)
        if not done:
            writer.writeheader()
        for key in wanted:
            if tuple(map(str, key)) in done:
                continue
            start = time.time()
            method, order, placement, points, cells = key
            mesh, at_points = runner.errors(method, order, cells, points, placement or "uniform")
            row = dict(zip(FIELDS, [*key, f"{mesh:.6e}", "" if at_points is None else f"{at_points:.6e}"]))
            writer.writerow(row)
            file.flush()
            done[tuple(map(str, key))] = {k: str(v) for k, v in row.items()}
            print(*row.values(), f"({time.time() - start:.1f} s)", flush=True)
    print_table(done, max_cells)
    if plot_path:
        plot(done, plot_path)


def of(done, method, order, placement, points, cells, field):
    row = done.get(tuple(map(str, (method, order, placement, points, cells))))
    return float(row[field]) if row and row[field] else None


def print_table(done, max_cells):
    print("\n| order | points | cells | published | at the points | difference | over the mesh | difference | "
          "at the points, cells + 2 | difference |\n|---|---|---|---|---|---|---|---|---|---|")
    for order, points, cells, reference in published():
        if cells > max_cells or (order, points) == (2, 1):
            continue
        columns = [str(order), str(points), f"{cells}³", f"{reference:.3g}"]
        for error in (of(done, "mpm", order, "uniform", points, cells, "error_points"),
                      of(done, "mpm", order, "uniform", points, cells, "error_mesh"),
                      of(done, "mpm", order, "uniform", points, cells + 2, "error_points") if order == 1 else None):
            columns += [f"{error:.4g}", f"{100 * (error / reference - 1):+.1f} %"] if error else ["", ""]
        print("| " + " | ".join(columns) + " |")


def plot(done, path):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(11, 4.6), sharey=True)
    colors = {1: "tab:gray", 8: "tab:blue", 27: "tab:orange", 64: "tab:green", 125: "tab:red"}
    for order, axis in zip((1, 2), axes):
        groups = sorted({p for o, p, _, _ in published() if o == order})
        for points in groups:
            theirs = [(n, e) for o, p, n, e in published() if (o, p) == (order, points)]
            axis.loglog(*zip(*theirs), "x", color=colors[points], ms=5)
            ours = sorted((int(k[4]), float(r["error_points"])) for k, r in done.items()
                          if k[:4] == ("mpm", str(order), "uniform", str(points)))
            if ours:
                axis.loglog(*zip(*ours), "-", color=colors[points], label=f"MPM, {points} uniform points")
        for method, placement, style, label in (("fem", "", "k-", "FEM"), ("mpm", "gauss", "k:", "MPM, Gauss points")):
            ours = sorted((int(k[4]), float(r["error_mesh"])) for k, r in done.items()
                          if (k[0], k[1], k[2]) == (method, str(order), placement))
            if ours:
                axis.loglog(*zip(*ours), style, label=label)
        axis.set_title(f"order {order} (crosses: published)")
        axis.set_xlabel("cells in each direction")
        axis.grid(True, which="both", alpha=0.3)
        axis.legend(fontsize=8)
    axes[0].set_ylabel("L2 error of the displacement")
    figure.tight_layout()
    figure.savefig(path, dpi=130)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--honeyguide", required=True, type=lambda p: str(pathlib.Path(p).resolve()))
    parser.add_argument("--mpiexec", help="to compare ranks in --check")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--max-cells", type=int, default=20)
    parser.add_argument("--csv", type=pathlib.Path, default=pathlib.Path("mms_linear.csv"))
    parser.add_argument("--plot", type=pathlib.Path)
    arguments = parser.parse_args()
    runner = Runner(arguments.honeyguide, arguments.mpiexec)
    if arguments.check:
        return check(runner)
    return study(runner, arguments.max_cells, arguments.csv, arguments.plot)


if __name__ == "__main__":
    sys.exit(main())
