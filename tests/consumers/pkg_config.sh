#!/usr/bin/env bash
# A program built with pkg-config and a bare C11 compiler. Environment: PREFIX LIBDIR SCRATCH SOURCE CC FLAGS
set -euo pipefail
command -v pkg-config > /dev/null || { echo "pkg-config is needed"; exit 1; }
export PKG_CONFIG_PATH=$PREFIX/$LIBDIR/pkgconfig
rm -rf "$SCRATCH"; mkdir -p "$SCRATCH"; cd "$SCRATCH"

pkg-config --exists --print-errors 'ceed >= 0.12'
if pkg-config --exists 'ceed >= 99'; then echo "pkg-config found ceed >= 99"; exit 1; fi
includedir=$(pkg-config --variable=includedir ceed)
libdir=$(pkg-config --variable=libdir ceed)
for folder in "$includedir" "$libdir"; do
  case $(realpath "$folder") in
    "$(realpath "$PREFIX")"/*) ;;
    *) echo "pkg-config gives $folder; expected a folder below $PREFIX"; exit 1 ;;
  esac
done

# shellcheck disable=SC2086,SC2046
$CC $FLAGS -std=c11 -Wall -Wextra -Wpedantic -Werror "$SOURCE/program.c" -I"$includedir/ceed/jit-source" \
  $(pkg-config --cflags --libs ceed) -lm -o program
LD_LIBRARY_PATH=$libdir ./program /cpu/self

# Programs linked against libCEED ask for libceed.so by that name, and so must ours.
readelf -d program | grep -q 'NEEDED.*\[libceed\.so\]' || { readelf -d program; echo "expected libceed.so as needed"; exit 1; }
