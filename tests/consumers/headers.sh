#!/usr/bin/env bash
# Each installed header by itself, as C11 and as C++17; QFunction headers as C11. Environment: PREFIX CC CXX
set -euo pipefail
cd "$PREFIX/include"
count=0
for header in ceed.h ceed/*.h; do
  [ "$header" = ceed/ceed-f64.h ] && continue # a part of ceed/types.h
  [ "$header" = ceed/fortran.h ] && continue # compiled by fortran.sh
  $CC -std=c11 -Wall -Wextra -Wpedantic -Werror -I. -fsyntax-only -x c - <<< "#include <$header>"
  $CXX -std=c++17 -Wall -Wextra -Wpedantic -Werror -I. -fsyntax-only -x c++ - <<< "#include <$header>"
  count=$((count + 1))
done
[ $count -ge 5 ] || { echo "only $count headers; expected ceed.h and those in ceed/"; exit 1; }

# Bindings of other languages read the header line by line and pass over the declaration with "...": it must be whole on
# one line.
open=$(grep -n ', \.\.\.)' ceed/ceed.h | grep -v -e '#define' -e 'CEED_EXTERN int CeedErrorImpl(.*);$' || true)
[ -z "$open" ] || { echo "variable arguments in a declaration of several lines: $open"; exit 1; }

qfunctions=0
while read -r header; do
  $CC -std=c11 -Wall -Wextra -Werror -Wno-unused -I. -fsyntax-only -x c - <<< "#include \"$header\""
  qfunctions=$((qfunctions + 1))
done < <(find ceed/jit-source/gallery -name '*.h' ! -name gallery.h)
[ $qfunctions -ge 18 ] || { echo "only $qfunctions QFunctions of the gallery; expected 18"; exit 1; }
echo "$count headers, $qfunctions QFunctions"
