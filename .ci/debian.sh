# shellcheck shell=bash disable=SC2034  # sourced: the lists are used by the scripts
# Shared by test.sh and demo.sh: the Debian packages that each needs, and how they are installed.

build_packages="build-essential cmake ninja-build pkg-config petsc-dev libopenmpi-dev openmpi-bin libhdf5-openmpi-dev
  libmetis-dev libcli11-dev nlohmann-json3-dev libfmt-dev libxxhash-dev libopenblas0-serial"
test_packages="libgtest-dev libbenchmark-dev valgrind git python3 libamdhip64-5 libhiprtc-builtins5"
plot_packages="python3 python3-matplotlib python3-h5py"
coverage_packages="gcovr"
docs_packages="doxygen python3-sphinx python3-myst-parser furo python3-breathe"

# install_packages NAME...: installs those that are not there yet, and says which.
install_packages() {
  local package missing=""
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "This is not a Debian system: make sure that it has what these packages hold, and pass --no-install:" >&2
    echo "  $*" >&2
    return 1
  fi
  for package in "$@"; do
    # shellcheck disable=SC2016
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing="$missing $package"
  done
  if [ -z "$missing" ]; then
    echo "All Debian packages needed are installed."
    return 0
  fi
  echo "Installing Debian packages:$missing"
  local as_root=""
  if [ "$(id -u)" != 0 ]; then
    as_root="sudo"
    command -v sudo >/dev/null || { echo "Not root, and no sudo: install these packages, then pass --no-install" >&2; return 1; }
  fi
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get update -q </dev/null
  # shellcheck disable=SC2086
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing </dev/null
}

# Open MPI refuses to run as root, and to run more ranks than cores, unless told that this is meant.
allow_mpi_anywhere() {
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
  export OMPI_MCA_btl_base_warn_component_unused=0 OMP_NUM_THREADS=1
}

step() { printf '\n== %s\n' "$*"; }

# value_of OPTION VALUE...: the value of an option, or an error where there is none.
value_of() { [ $# -ge 2 ] || { echo "$0: $1 needs a value" >&2; exit 2; }; printf '%s' "$2"; }

# python_with MODULE...: a python3 that has them. Debian's comes first: another may stand before it in PATH.
python_with() {
  local python
  for python in /usr/bin/python3 python3; do
    if "$python" -c "import $(IFS=,; echo "$*")" 2>/dev/null; then
      echo "$python"
      return 0
    fi
  done
  echo "No python3 with $*: on Debian, install$(printf ' python3-%s' "$@")" >&2
  return 1
}
