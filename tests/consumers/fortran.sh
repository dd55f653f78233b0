#!/usr/bin/env bash
# A program in Fortran, built with pkg-config and gfortran, calls every procedure that the library has for it.
# Environment: PREFIX LIBDIR SCRATCH SOURCE FC FLAGS
set -euo pipefail
export PKG_CONFIG_PATH=$PREFIX/$LIBDIR/pkgconfig
rm -rf "$SCRATCH"; mkdir -p "$SCRATCH"; cd "$SCRATCH"
program=$SOURCE/fortran/program.f90

# All of them are called.
nm -D --defined-only "$PREFIX/$LIBDIR/libceed.so" | awk '{print $3}' | grep -E '^ceed[a-z0-9]+_$' | sed 's/_$//' | sort > stubs
grep -oiE 'call +ceed[a-z0-9]+' "$program" | awk '{print $2}' | sort -u > called
[ "$(wc -l < stubs)" -ge 87 ] || { echo "only $(wc -l < stubs) procedures; expected 87"; exit 1; }
uncalled=$(comm -23 stubs called)
[ -z "$uncalled" ] || { echo "not called:"; echo "$uncalled"; exit 1; }

# Offsets lead out of the arrays that are passed, as the interface has it: no optimisation that builds on their bounds.
# shellcheck disable=SC2086,SC2046
"$FC" $FLAGS -O0 -Wall -Wno-unused-dummy-argument -Wno-unused-variable -fno-range-check "$program" -o program \
  $(pkg-config --cflags --libs ceed) 2> warnings || { cat warnings; exit 1; }
CEED_ERROR_HANDLER=return LD_LIBRARY_PATH=$PREFIX/$LIBDIR ./program /cpu/self > printed || { tail -5 printed; exit 1; }
grep -q 'all is well' printed || { tail -5 printed; exit 1; }

# The older name of the header.
cat > old.f90 << 'END'
      program old
      implicit none
      include 'ceedf.h'
      if (ceed_hex/=196614) stop 1
      end
END
# shellcheck disable=SC2046
"$FC" old.f90 -o old $(pkg-config --cflags ceed) && ./old
echo "$(wc -l < stubs) procedures"
