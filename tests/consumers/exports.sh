#!/usr/bin/env bash
# The library exports what its headers declare and nothing else; data symbols have the sizes that programs linked
# against libCEED have copied. Environment: PREFIX LIBDIR SCRATCH
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
foreign=$(grep -vE '^(Ceed|CEED_|ceed[a-z0-9]*_$)' exported || true)
[ -z "$foreign" ] || { echo "exported, not of the interface:"; echo "$foreign"; exit 1; }

readelf -sW --dyn-syms "$library" > symbols
while read -r name size; do
  got=$(awk -v name="$name" '$8 == name && $4 == "OBJECT" {size = $3} END {print size}' symbols)
  [ "$((got))" = "$size" ] || { echo "$name has ${got:-no} bytes; expected $size"; exit 1; }
done << 'SIZES'
CEED_VECTOR_ACTIVE 8
CEED_VECTOR_NONE 8
CEED_BASIS_NONE 8
CEED_ELEMRESTRICTION_NONE 8
CEED_QFUNCTION_NONE 8
CEED_REQUEST_IMMEDIATE 8
CEED_REQUEST_ORDERED 8
CEED_STRIDES_BACKEND 12
CeedErrorTypes 8
CeedMemTypes 16
CeedCopyModes 24
CeedTransposeModes 16
CeedEvalModes 136
CeedQuadModes 16
CeedElemTopologies 1572920
CeedContextFieldTypes 32
CeedFESpaces 32
SIZES
echo "$count declarations"
