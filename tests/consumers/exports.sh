#!/usr/bin/env bash
# The library exports all that its headers declare. Environment: PREFIX LIBDIR SCRATCH
set -euo pipefail
rm -rf "$SCRATCH"; mkdir -p "$SCRATCH"; cd "$SCRATCH"
library=$PREFIX/$LIBDIR/libceed.so
nm -D --defined-only "$library" | awk '{print $3}' | sort -u > exported

# Names after CEED_EXTERN: functions up to the parenthesis, data up to ; or [.
grep -hE '^CEED_EXTERN ' "$PREFIX"/include/ceed/*.h |
  sed -E 's/^CEED_EXTERN [^(;[]*[ *](Ceed[A-Za-z0-9]+|CEED_[A-Z_]+)[][0-9]*[(;[].*/\1/' | sort -u > declared
count=$(wc -l < declared)
[ "$count" -ge 200 ] || { echo "only $count declarations found in the headers"; exit 1; }
grep -vE '^(Ceed[A-Za-z0-9]+|CEED_[A-Z_]+)$' declared | grep -v ceed_plugin_v1 && { echo "declarations not understood"; exit 1; }
missing=$(grep -v ceed_plugin_v1 declared | comm -23 - exported)
[ -z "$missing" ] || { echo "declared, not exported:"; echo "$missing"; exit 1; }
echo "$count declarations"
