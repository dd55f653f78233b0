#!/usr/bin/env bash
# Programs built by make, which knows the prefix and nothing else. Environment: PREFIX LIBDIR SCRATCH SOURCE CC CXX FLAGS
set -euo pipefail
command -v make > /dev/null || { echo "make is needed"; exit 1; }
rm -rf "$SCRATCH"; mkdir -p "$SCRATCH"; cd "$SCRATCH"
cp "$SOURCE/makefile/Makefile" "$SOURCE/program.c" "$SOURCE/package/program.cpp" .
make -s check PREFIX="$PREFIX" LIBDIR="$PREFIX/$LIBDIR" CC="$CC" CXX="$CXX" \
  CFLAGS="-O2 -Wall -Wextra -Werror $FLAGS" CXXFLAGS="-O2 -Wall -Wextra -Werror $FLAGS"
