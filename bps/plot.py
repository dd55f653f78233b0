#!/usr/bin/env python3
"""Draw the throughput of bake-off runs over degree and over size, one line for each backend.

Reads the JSON files that bps-kernel --json and bps -json write, and writes one PNG: a row for each problem, on the left
the best throughput at each degree, on the right the throughput at each size, one line for each degree. Runs that all
have about one size are drawn over degree alone, two problems in a row.
"""
import argparse
import collections
import json
import sys

QUANTITIES = {
    "mdofs_per_s": "million DoFs/s",
    "mpoints_per_s": "million points/s",
    "gb_per_s": "GB/s (compulsory)",
    "gflops_per_s": "GFLOP/s",
    "cg_mdofs_per_s": "million DoFs/s in CG",
}
# Okabe and Ito's colours: told apart in print and with any colour vision.
COLORS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#F0E442"]
MARKERS = "osD^v<>Ph"


def fail(message):
    sys.exit(f"plot.py: {message}")


def read_records(paths):
    records = []
    for path in paths:
        try:
            with open(path, encoding="utf-8") as file:
                content = json.load(file)
        except OSError as error:
            fail(f"{path}: {error.strerror}")
        except ValueError as error:
            fail(f"{path}: not a JSON file: {error}")
        if not isinstance(content, list):
            fail(f"{path}: expected a list of records")
        for record in content:
            missing = [key for key in ("problem", "ceed", "degree", "dofs", "ranks") if key not in record]
            if missing:
                fail(f"{path}: a record lacks {', '.join(missing)}")
        records += content
    if not records:
        fail("no records to draw")
    return records


def backend_labels(records):
    """A label for each record: the resource, and whatever else distinguishes the runs of this plot."""
    versions = {record.get("library_version") for record in records}
    ranks = {record["ranks"] for record in records}

    def label(record):
        text = record["ceed"]
        if record.get("placement"):
            text += f", {record['points_per_cell']} {record['placement']} points"
        if len(ranks) > 1:
            text += f", {record['ranks']} rank{'s' if record['ranks'] > 1 else ''}"
        if len(versions) > 1:
            text += f" ({record.get('library_version')})"
        return text

    return [label(record) for record in records]


def draw(records, quantity, title):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    labels = backend_labels(records)
    backends = sorted(set(labels))
    problems = sorted({record["problem"] for record in records})
    degrees = sorted({record["degree"] for record in records})
    color = {backend: COLORS[i % len(COLORS)] for i, backend in enumerate(backends)}
    marker = {degree: MARKERS[i % len(MARKERS)] for i, degree in enumerate(degrees)}

    sizes = [record["dofs"] for record in records]
    has_sizes = max(sizes) > 2 * min(sizes)
    num_rows = len(problems) if has_sizes else (len(problems) + 1) // 2
    figure, axes = plt.subplots(num_rows, 2, figsize=(10, 0.9 + 2.9 * num_rows), squeeze=False)
    panels = axes if has_sizes else [(axis, None) for axis in axes.flat]
    for axis, _ in panels[len(problems):]:
        axis.set_visible(False)
    for (over_degree, over_size), problem in zip(panels, problems):
        best = collections.defaultdict(dict)
        lines = collections.defaultdict(list)
        for record, backend in zip(records, labels):
            if record["problem"] != problem:
                continue
            degree, value = record["degree"], record[quantity]
            best[backend][degree] = max(value, best[backend].get(degree, 0))
            lines[backend, degree].append((record["dofs"], value))
        for backend in sorted(best):
            xs, ys = zip(*sorted(best[backend].items()))
            over_degree.plot(xs, ys, marker="o", color=color[backend], label=backend)
        over_degree.set_xticks(degrees)
        if has_sizes:
            for (backend, degree), points in sorted(lines.items()):
                xs, ys = zip(*sorted(points))
                over_size.plot(xs, ys, marker=marker[degree], color=color[backend], linewidth=1)
            over_size.set_xscale("log")
        for axis in (over_degree, over_size) if has_sizes else (over_degree,):
            axis.set_ylim(bottom=0)
            axis.grid(True, linewidth=0.3)
            axis.set_title(problem.upper(), loc="left", fontsize=10)
        over_degree.set_ylabel(QUANTITIES[quantity])
    axes[-1][0].set_xlabel("degree p")
    axes[-1][1].set_xlabel("DoFs" if has_sizes else "degree p")
    if has_sizes:
        for degree in degrees:
            axes[0][1].plot([], [], marker=marker[degree], color="gray", linewidth=0, label=f"p = {degree}")
        axes[0][1].legend(fontsize=7, ncol=2)
    handles = [plt.Line2D([], [], marker="o", color=color[backend], label=backend) for backend in backends]
    figure.legend(handles=handles, fontsize=8, loc="lower center", ncol=min(2, len(backends)))
    figure.suptitle(title, fontsize=11)
    rows = (len(backends) + 1) // 2
    height = figure.get_figheight()
    figure.tight_layout(rect=(0, (0.25 + 0.2 * rows) / height, 1, 1))
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", metavar="FILE", help="JSON file of bps-kernel or bps")
    parser.add_argument("-o", "--output", default="bps.png", help="picture to write (default: %(default)s)")
    parser.add_argument("-q", "--quantity", choices=QUANTITIES, default="mdofs_per_s", help="(default: %(default)s)")
    parser.add_argument("-p", "--problem", action="append", help="draw this problem only; repeat for several")
    arguments = parser.parse_args()

    records = read_records(arguments.files)
    if arguments.problem:
        known = sorted({record["problem"] for record in records})
        for problem in arguments.problem:
            if problem not in known:
                fail(f"--problem {problem}: the files have {', '.join(known)}")
        records = [record for record in records if record["problem"] in arguments.problem]
    if any(arguments.quantity not in record for record in records):
        fail(f"--quantity {arguments.quantity}: a record lacks it")
    processors = sorted({record.get("cpu", "unknown") for record in records})
    figure = draw(records, arguments.quantity, f"Bake-off problems on {', '.join(processors)}")
    try:
        figure.savefig(arguments.output, dpi=130, format="png")
    except OSError as error:
        fail(f"{arguments.output}: {error.strerror}")
    print(f"{arguments.output}: {len(records)} records")


if __name__ == "__main__":
    main()
