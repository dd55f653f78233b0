#!/usr/bin/env bash
# Builds Honeyguide and shows it: a table of bake-off problems over every backend that works here, then a dense cube that
# sinks in a soft one, by finite elements and by material points, beside published curves. Five minutes on two cores.
set -euo pipefail
cd "$(dirname "$0")"
source .ci/debian.sh

usage() {
  cat <<END
usage: ./demo.sh [options]
  -j N             parallel jobs of the build (default: all cores)
  --build-dir DIR  where to build (default: build/release)
  --results DIR    where the results go (default: demo-results)
  --no-install     do not install Debian packages
END
}

jobs=$(nproc) build_dir=build/release results=demo-results install=yes
while [ $# -gt 0 ]; do
  case "$1" in
    -j) jobs=$(value_of "$@"); shift ;;
    -j?*) jobs=${1#-j} ;;
    --build-dir) build_dir=$(value_of "$@"); shift ;;
    --results) results=$(value_of "$@"); shift ;;
    --no-install) install=no ;;
    -h|--help) usage; exit 0 ;;
    *) echo "demo.sh: unknown option '$1'" >&2; usage >&2; exit 2 ;;
  esac
  shift
done

if [ $install = yes ]; then
  step "Packages"
  # shellcheck disable=SC2086
  install_packages $build_packages $plot_packages
fi
allow_mpi_anywhere
python=$(python_with matplotlib h5py)
SECONDS=0

step "Build in $build_dir"
cmake --preset release -B "$build_dir"
cmake --build "$build_dir" -j "$jobs" --target bps-kernel honeyguide

bin=$(realpath "$build_dir")/bin
source_dir=$PWD
rm -rf "$results"
mkdir -p "$results"
cd "$results"

step "Bake-off: operators on every backend that works here"
"$bin/bps-kernel" --ceed all --problem all --degree 1-4 --dofs 3e4 --quiet --json bps.json
echo
echo "The same at 27 material points in each cell:"
"$bin/bps-kernel" --ceed all --problem bp1,bp3,bp4 --degree 1-3 --points 27 --dofs 1e4 --quiet --json bps-points.json

step "Sinker by finite elements, 5x5x5 cells, 20 load steps"
"$bin/honeyguide" -options_file "$source_dir/ratel-like/examples/sinker-fem.yml" \
  -ts_monitor_quantities sinker-fem.csv -ts_monitor_diagnostic_quantities sinker-fem \
  -probe "$("$python" "$source_dir/docs/verification/plot_sinker.py" --print-probes 5)"

step "Sinker by material points, 5x5x5 cells, 27 points in each, 20 load steps"
"$bin/honeyguide" -options_file "$source_dir/ratel-like/examples/sinker-mpm.yml" \
  -ts_monitor_quantities sinker-mpm.csv -ts_monitor_swarm sinker-mpm

step "Downward displacement, and its difference from the published curves"
"$python" "$source_dir/docs/verification/plot_sinker.py" fem:5:sinker-fem.csv mpm:5:sinker-mpm.csv \
  --points sinker-mpm-000020.h5 --output sinker.png

step "Done in $SECONDS s. In $PWD:"
show() { [ -s "$1" ] || { echo "demo.sh: $1 was not made" >&2; exit 1; }; printf '  %-18s %s\n' "$1" "$2"; }
show sinker.png "force against displacement beside the published points, and the points at the end"
show sinker-fem.pvd "the mesh at every step: open in ParaView"
show sinker-mpm.xdmf "the material points at every step: open in ParaView (reader: Xdmf3ReaderS)"
show sinker-fem.csv "what was monitored, by finite elements"
show sinker-mpm.csv "what was monitored, by material points"
show bps.json "the bake-off, one record for each line of the table"
show bps-points.json "the bake-off at material points"
