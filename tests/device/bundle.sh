#!/usr/bin/env bash
# Packs the mechanics program with all that it loads into one archive, for a machine with a GPU that has neither PETSc nor
# MPI: build/device/bundle.tar.xz, at most 60 MB. Its run.sh solves the sinker there, or runs `honeyguide` with the arguments
# that it is given.
set -euo pipefail
cd "$(dirname "$0")/../.."

build=${1:-build/release}
[ -x "$build/bin/honeyguide" ] || { echo "bundle.sh: there is no $build/bin/honeyguide; give the build folder" >&2; exit 2; }
bundle=build/device/bundle
rm -rf "$bundle"
mkdir -p "$bundle"/{bin,lib,include/ceed}
cp "$build/bin/honeyguide" "$bundle/bin/"
cp -P "$build"/lib/libceed.so* "$bundle/lib/"
cp -r "$build/lib/ceed-plugins" "$bundle/lib/"
cp -r qfunctions "$bundle/include/ceed/jit-source"  # which the library finds beside itself
cp -r ratel-like/examples "$bundle/examples"

# What the program and the plugins load, but for what belongs to a system: the C library and its loader.
libraries_of() {
  ldd "$@" 2>/dev/null | awk '$3 ~ "^/" { print $3 }' | sort -u |
    grep -vE '/(ld-linux.*|libc|libm|libdl|librt|libpthread|libresolv|libutil)\.so' | grep -v "/libceed.so" || true
}
# The parts that Open MPI loads, which are found by OPAL_PKGLIBDIR.
mpi=$(dirname "$(realpath "$(ldd "$build/bin/honeyguide" | awk '$1 ~ /^libmpi\.so/ { print $3 }')")")/openmpi
parts=()
if [ -d "$mpi/lib/openmpi3" ]; then
  mkdir -p "$bundle/openmpi/lib" "$bundle/openmpi/share"
  cp -r "$mpi/lib/openmpi3" "$bundle/openmpi/lib/"
  cp -r /usr/share/openmpi "$bundle/openmpi/share/" 2>/dev/null || true
  parts=("$mpi"/lib/openmpi3/*.so)
fi
libraries_of "$build/bin/honeyguide" "$build"/lib/ceed-plugins/*.so "${parts[@]}" | while read -r library; do
  cp -L "$library" "$bundle/lib/"
done
strip --strip-unneeded "$bundle"/bin/* "$bundle"/lib/*.so* "$bundle"/lib/ceed-plugins/*.so 2>/dev/null || true

cat > "$bundle/run.sh" <<'END'
#!/usr/bin/env bash
# Solves the sinker on a backend (default: /gpu/cuda/gen), with the time of operators and what was copied; or runs honeyguide
# with the arguments of the command line.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
export LD_LIBRARY_PATH=$here/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}:/usr/local/cuda/lib64:/opt/rocm/lib
export OPAL_PREFIX=$here/openmpi OPAL_PKGLIBDIR=$here/openmpi/lib/openmpi3 OPAL_PKGDATADIR=$here/openmpi/share/openmpi
export OMPI_MCA_ess_singleton_isolated=1 OMPI_MCA_plm=isolated OMPI_MCA_pml=ob1 OMPI_MCA_btl=self OMPI_MCA_osc=^ucx
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1
export CEED_CACHE_DIR=${CEED_CACHE_DIR:-$here/compiled}
if [ $# -gt 0 ]; then exec "$here/bin/honeyguide" "$@"; fi
exec "$here/bin/honeyguide" -options_file "$here/examples/sinker-mpm.yml" -dm_plex_box_faces 10,10,10 \
  -ceed "${HONEYGUIDE_CEED:-/gpu/cuda/gen}" -mat_type shell -ts_max_steps 3 -log_view
END
chmod +x "$bundle/run.sh"

archive=build/device/bundle.tar.xz
tar -C build/device -cJf "$archive" bundle
size=$(stat -c %s "$archive")
printf '%s: %.1f MB\n' "$archive" "$(awk "BEGIN { print $size / 1e6 }")"
[ "$size" -le 60000000 ] || { echo "bundle.sh: more than 60 MB" >&2; exit 1; }
