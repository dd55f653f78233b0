#!/usr/bin/env bash
# Gathers what run.sh needs beside this repository, for a machine that has neither these packages nor a network:
# GoogleTest, fmt, CLI11, nlohmann-json and xxhash as Debian has them, in build/device/prefix (about 30 MB).
set -euo pipefail
cd "$(dirname "$0")/../.."
source .ci/debian.sh
packages="libgtest-dev libgmock-dev libfmt-dev libfmt9 libcli11-dev nlohmann-json3-dev libxxhash-dev"
# shellcheck disable=SC2086
[ "${1:-}" = --no-install ] || install_packages $packages
prefix=build/device/prefix
rm -rf "$prefix"
mkdir -p "$prefix"
for package in $packages; do
  dpkg -L "$package" | grep -E '^/usr/(include|lib|share/cmake|share/pkgconfig|src)/' | while read -r file; do
    if [ -f "$file" ] || [ -L "$file" ]; then echo "${file#/}"; fi
  done
done | tar -C / -cf - -T - | tar -C "$prefix" -xf -
du -sh "$prefix"
