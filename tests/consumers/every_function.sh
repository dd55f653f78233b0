#!/usr/bin/env bash
# A program that names every function and every object of data that the public headers declare, compiled with them alone
# as C11 and as C++17, links and runs. Environment: PREFIX LIBDIR SCRATCH CC CXX FLAGS
set -euo pipefail
export PKG_CONFIG_PATH=$PREFIX/$LIBDIR/pkgconfig
rm -rf "$SCRATCH"; mkdir -p "$SCRATCH"; cd "$SCRATCH"

# Declarations, each on one line: up to the parenthesis for functions, up to [ or ; for data.
cat "$PREFIX"/include/ceed/{ceed,types,backend,plugin,jit-tools,cuda,hip}.h | grep -E '^CEED_EXTERN ' > declarations
sed -nE 's/^CEED_EXTERN [^(;[]*[ *](Ceed[A-Za-z0-9]+)\(.*/\1/p' declarations | sort -u > functions
sed -nE 's/^CEED_EXTERN [^(]*[ *](Ceed[A-Za-z0-9]+|CEED_[A-Z_]+)(\[[0-9]*\])?;.*/\1/p' declarations | sort -u > data
declared=$(sort -u declarations | grep -vc 'ceed_plugin_v1')
named=$(($(wc -l < functions) + $(wc -l < data)))
[ "$declared" = "$named" ] || { echo "$declared declarations, $named of them understood"; exit 1; }
[ "$(wc -l < functions)" -ge 240 ] || { echo "only $(wc -l < functions) functions; expected those of libCEED"; exit 1; }

{
  cat << 'END'
#include <ceed.h>
#include <ceed/backend.h>
#include <ceed/cuda.h>
#include <ceed/hip.h>
#include <ceed/jit-tools.h>
#include <ceed/plugin.h>
#include <stdio.h>
#include <string.h>

CEED_QFUNCTION_HELPER CeedScalar twice(const CeedScalar x) { return 2 * x; }
CEED_QFUNCTION(doubled)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) out[0][i] = twice(in[0][i]);
  return CEED_ERROR_SUCCESS;
}

typedef void (*Function)(void);
static Function const functions[] = {
END
  sed 's/.*/    (Function)&,/' functions
  echo '};'
  echo 'static const void *const data[] = {'
  sed 's/.*/    (const void *)\&&,/' data
  cat << 'END'
};

int main(void) {
  size_t count = 0;
  for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++) count += functions[i] != NULL;
  for (size_t i = 0; i < sizeof data / sizeof data[0]; i++) count += data[i] != NULL;
  const CeedScalar in[2] = {1, 2}, *ins[1] = {in};
  CeedScalar out[2] = {0, 0}, *outs[1] = {out};
  if (doubled(NULL, 2, ins, outs) != 0 || out[1] != 4 || strstr(doubled_loc, ":doubled") == NULL) return 1;
  if (CeedIntPow(2, 5) != 32 || CeedIntMin(2, 5) != 2 || CeedIntMax(2, 5) != 5) return 1;
  printf("%zu of %zu\n", count, sizeof functions / sizeof functions[0] + sizeof data / sizeof data[0]);
  return count == sizeof functions / sizeof functions[0] + sizeof data / sizeof data[0] ? 0 : 1;
}
END
} > program.c
cp program.c program.cpp

# shellcheck disable=SC2086,SC2046
$CC $FLAGS -std=c11 -Wall -Wextra -Wpedantic -Werror program.c -o program_c $(pkg-config --cflags --libs ceed)
# shellcheck disable=SC2086,SC2046
$CXX $FLAGS -std=c++17 -Wall -Wextra -Wpedantic -Werror program.cpp -o program_cpp $(pkg-config --cflags --libs ceed)
export LD_LIBRARY_PATH=$PREFIX/$LIBDIR
./program_c
./program_cpp
