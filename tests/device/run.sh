#!/usr/bin/env bash
# On a machine with a GPU: are its backends right, and how fast are they?
# The last thing printed is a table; the exit status is 0 if every test passed.
set -euo pipefail
cd "$(dirname "$0")/../.."

usage() {
  cat <<END
usage: tests/device/run.sh [options]
Each step gets a part of the time that is left of --limit; one that takes longer is stopped, which is a failure.
  --backend cuda|hip|emu  whose backends: /gpu/<backend>/... (default: cuda)
  --out DIR               where JSON records and logs go (default: build/device/results)
  --prefix DIR            where GoogleTest, fmt, CLI11, nlohmann-json and xxhash are (default: build/device/prefix, which
                          pack.sh fills; where it is not there, the system's)
  --dofs N                size of the timed problems (default: 1e7)
  --degrees A-B           their degrees (default: 1-8; at points 1-3)
  --limit N               seconds for all of it (default: 480)
  -j N                    parallel jobs (default: all cores)
END
}

backend=cuda out=build/device/results prefix=build/device/prefix dofs=1e7 degrees=1-8 limit=480 jobs=$(nproc)
while [ $# -gt 0 ]; do
  case "$1" in
    --backend) backend=$2; shift ;;
    --out) out=$2; shift ;;
    --prefix) prefix=$2; shift ;;
    --dofs) dofs=$2; shift ;;
    --degrees) degrees=$2; shift ;;
    --limit) limit=$2; shift ;;
    -j) jobs=$2; shift ;;
    -h|--help) usage; exit 0 ;;
    *) echo "run.sh: unknown option '$1'" >&2; usage >&2; exit 2 ;;
  esac
  shift
done
case "$backend" in cuda|hip|emu) ;; *) echo "run.sh: --backend is '$backend'; expected cuda, hip or emu" >&2; exit 2 ;; esac

started=$SECONDS
step() { printf '\n== %s (%d s)\n' "$*" $((SECONDS - started)); }
# Runs a command for at most so many hundredths of what is left of the time.
within() {
  local seconds=$(((limit - SECONDS + started) * $1 / 100))
  timeout --kill-after=5 $((seconds > 1 ? seconds : 1)) "${@:2}"
}
mkdir -p "$out"
rm -f "$out"/{bandwidth,bps,points}*.json
build=build/device/build
export CEED_CACHE_DIR=$PWD/build/device/compiled CEED_JIT_ERROR_ON_FAILURE=1
# Of the random cases, each of which is a kernel that is compiled, one in five.
export HG_CASES=${HG_CASES:-20}
# The vendor's compiler where it is installed beside the system's libraries.
export LD_LIBRARY_PATH=${LD_LIBRARY_PATH:+$LD_LIBRARY_PATH:}/usr/local/cuda/lib64:/opt/rocm/lib

step "Machine"
date -u +'%F %H:%M UTC'
nvidia-smi --query-gpu=name,driver_version,memory.total --format=csv,noheader 2>/dev/null || true
lscpu 2>/dev/null | sed -n 's/^Model name: *//p' || true

step "Build in $build"
where=()
[ ! -d "$prefix" ] || where=(-DCMAKE_PREFIX_PATH="$PWD/$prefix/usr;$PWD/$prefix/usr/lib/$(uname -m)-linux-gnu"
                             -DCMAKE_INCLUDE_PATH="$PWD/$prefix/usr/include")
# Any compiler may be there, with warnings of its own.
cmake -S . -B "$build" -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=ON -DHONEYGUIDE_MECHANICS=OFF -DHONEYGUIDE_WERROR=OFF \
  "${where[@]}" > "$out/configure.log" 2>&1 || { tail -20 "$out/configure.log"; exit 1; }
within 80 cmake --build "$build" -j "$jobs" --target ceed_$backend ceed-info ceed-conformance bps-kernel device-bandwidth \
  > "$out/build.log" 2>&1 || { tail -30 "$out/build.log"; exit 1; }

step "Backends"
"$build/bin/ceed-info" | grep -A3 "^/gpu/$backend" || true
mapfile -t resources < <("$build/bin/ceed-info" --json - | python3 -c "
import json, sys
for b in json.load(sys.stdin)['backends']:
    if b['resource'].startswith('/gpu/$backend/') and b['available']: print(b['resource'])")
[ ${#resources[@]} -gt 0 ] || { echo "no backend /gpu/$backend/... works here"; exit 1; }

# The suite in as many parts at a time as there are cores: most of it is compiling.
status=0
suite=$(find "$build" -name ceed-conformance -type f -perm -u+x | head -1)
for resource in "${resources[@]}"; do
  step "Conformance: $resource"
  log=$out/conformance$(tr / _ <<<"$resource")
  rm -f "$log".*.log
  parts=()
  for part in $(seq 0 $((jobs - 1))); do
    GTEST_TOTAL_SHARDS=$jobs GTEST_SHARD_INDEX=$part within 45 "$suite" --ceed "$resource" > "$log.$part.log" 2>&1 &
    parts+=($!)
  done
  stopped=0
  for part in "${parts[@]}"; do
    code=0
    wait "$part" || code=$?
    [ $code -eq 0 ] || status=1
    [ $code -le 1 ] || stopped=$((stopped + 1))
  done
  printf '%s passed, ' "$(cat "$log".*.log | grep -c '^\[       OK')"
  cat "$log".*.log | grep '^\[  FAILED' | grep ' ms)' || echo "none failed"
  [ $stopped -eq 0 ] || echo "$stopped of $jobs parts did not come to their end: see $log.*.log"
done

sanitizer=$(command -v compute-sanitizer || ls /usr/local/cuda/bin/compute-sanitizer 2>/dev/null || true)
if [ "$backend" = cuda ] && [ -n "$sanitizer" ]; then
  step "compute-sanitizer"
  for tool in memcheck racecheck initcheck; do
    echo "$tool"
    within 20 "$sanitizer" --tool $tool --error-exitcode 1 "$suite" --ceed "${resources[0]}" \
      --gtest_filter='*Vector*:*OperatorTest*:*PointsTest*' > "$out/$tool.log" 2>&1 || status=1
    tail -1 "$out/$tool.log"
  done
elif [ "$backend" = cuda ]; then
  echo "compute-sanitizer: skipped, there is none"
fi

step "Copies"
for resource in "${resources[@]}"; do
  within 20 "$build/bin/device-bandwidth" "$resource" --json "$out/bandwidth$(tr / _ <<<"$resource").json" || status=1
done

points_dofs=$(python3 -c "print(max(8, float('$dofs') / 5))")  # points are placed on the host, which takes longer
for resource in "${resources[@]}"; do
  case "$resource" in */ref) continue ;; esac  # in stages: right, not fast
  name=$(tr / _ <<<"$resource")
  step "Bake-off problems: $resource"
  within 60 "$build/bin/bps-kernel" --ceed "$resource" --problem all --degree "$degrees" --dofs "$dofs" --reps 5 \
    --cg-iterations 1 --json "$out/bps$name.json" > "$out/bps$name.log" 2>&1 || { tail -5 "$out/bps$name.log"; status=1; }
  within 90 "$build/bin/bps-kernel" --ceed "$resource" --problem bp1,bp2,bp3,bp4 --degree 1-3 --points 8,27,64 \
    --dofs "$points_dofs" --reps 5 --cg-iterations 1 --json "$out/points$name.json" > "$out/points$name.log" 2>&1 ||
    { tail -5 "$out/points$name.log"; status=1; }
done

step "Table"
python3 tests/device/table.py "$out"
exit $status
