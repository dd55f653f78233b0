#!/usr/bin/env bash
# Builds everything and runs the tests. On Debian 12 it first installs the packages it needs.
# The exit status is that of the tests; ctest's summary is the last thing printed (but for coverage).
set -euo pipefail
cd "$(dirname "$0")"
source .ci/debian.sh

usage() {
  cat <<END
usage: ./test.sh [options]
  -L, --labels A|B|C  only tests with one of these labels:
                      interface conformance bps mechanics consumers docs long
  -j N                parallel jobs (default: all cores)
  --preset NAME       release (default), debug, asan, tsan or coverage: see CMakePresets.json;
                      coverage lists the lines reached at the end, and fails below 95 % of interface/ and backends/ref/
  --build-dir DIR     where to build (default: build/<preset>)
  --sanitizers        as well: the tests of the core library again, under the address and undefined behaviour sanitizers
  --no-install        do not install Debian packages
END
}

labels="" jobs=$(nproc) preset=release build_dir="" sanitizers=no install=yes
while [ $# -gt 0 ]; do
  case "$1" in
    -L|--labels) labels=$(value_of "$@"); shift ;;
    -j) jobs=$(value_of "$@"); shift ;;
    -j?*) jobs=${1#-j} ;;
    --preset) preset=$(value_of "$@"); shift ;;
    --build-dir) build_dir=$(value_of "$@"); shift ;;
    --sanitizers) sanitizers=yes ;;
    --no-install) install=no ;;
    -h|--help) usage; exit 0 ;;
    *) echo "test.sh: unknown option '$1'" >&2; usage >&2; exit 2 ;;
  esac
  shift
done
[[ "$jobs" =~ ^[1-9][0-9]*$ ]] || { echo "test.sh: -j wants a positive number, not '$jobs'" >&2; exit 2; }
build_dir=${build_dir:-build/$preset}

if [ $install = yes ]; then
  step "Packages"
  # shellcheck disable=SC2086
  install_packages $build_packages $test_packages $plot_packages $docs_packages \
    $([ "$preset" != coverage ] || echo "$coverage_packages")
fi
allow_mpi_anywhere

build() {  # build PRESET DIR [CMAKE OPTION]...
  step "Build: $1 in $2"
  cmake --preset "$1" -B "$2" -DBUILD_TESTING=ON "${@:3}"
  cmake --build "$2" -j "$jobs"
}

# Labels that must have tests, and the way to select them.
IFS='|' read -ra wanted <<<"${labels:-interface|conformance|bps|mechanics|consumers|docs|long}"
select=()
[ -z "$labels" ] || select=(-L "$labels")

build "$preset" "$build_dir"
join=(--into "$build_dir/all" --require "${wanted[@]}")
if [ $sanitizers = yes ]; then
  build asan "$build_dir-asan" -DHONEYGUIDE_MECHANICS=OFF -DHONEYGUIDE_BPS=OFF
  join+=(--second "$build_dir-asan" --prefix asan. --labels interface conformance --without long)
fi
python3 .ci/join_tests.py "${join[@]}" -- "$build_dir"

step "Tests"
tests=(ctest --test-dir "$build_dir/all" -j "$jobs" --output-on-failure --no-tests=error "${select[@]}")
[ "$preset" = coverage ] || exec "${tests[@]}"
status=0
"${tests[@]}" || status=$?
step "Coverage"
cmake --build "$build_dir" --target coverage
exit $status
