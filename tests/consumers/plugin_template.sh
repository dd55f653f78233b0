#!/usr/bin/env bash
# The template of a backend is built against the installed library, as the manual says, and checked by the installed
# ceed-info. Environment: PREFIX LIBDIR SCRATCH SOURCE CC FLAGS
set -euo pipefail
rm -rf "$SCRATCH"; mkdir -p "$SCRATCH"; cd "$SCRATCH"
info=$PREFIX/bin/ceed-info
export CEED_PLUGIN_PATH=

fail() { echo "$1"; [ $# -lt 2 ] || cat "$2"; exit 1; }
expect() { grep -qF -- "$2" "$1" || fail "expected '$2' in:" "$1"; }

# The sources know nothing of where they stand.
cp -r "$SOURCE/plugin_template" source
lines=$(cat source/* | wc -l)
[ "$lines" -le 230 ] || fail "the template has $lines lines; expected about 200"
cmake -S source -B template -DCMAKE_PREFIX_PATH="$PREFIX" -DCMAKE_C_COMPILER="$CC" -DCMAKE_C_FLAGS="$FLAGS" > log 2>&1 ||
  fail "the template does not configure:" log
cmake --build template > log 2>&1 || fail "the template does not build:" log

# One exported symbol.
for name in first backend; do
  exported=$(nm -D --defined-only template/$name.so | awk '{print $3}' | grep -vE '^(_init|_fini)$|gcov|^mangle_path$|__asan' || true)
  [ "$exported" = ceed_plugin_v1 ] || fail "$name.so exports $exported; expected ceed_plugin_v1 alone"
done

# By an explicit load, the whole suite; and in CEED_PLUGIN_PATH.
some='*Restriction*:*OperatorTest*'
"$info" --plugin template/first.so --check /cpu/self/first --cases "$some" > log 2>&1 || fail "first.so:" log
"$info" --plugin template/backend.so --check /cpu/self/template > log 2>&1 || fail "backend.so:" log
expect log " 0 failed, 0 crashed, 0 skipped"
CEED_PLUGIN_PATH=$PWD/template "$info" --support --ceed /cpu/self/template --ceed /cpu/self/first --cases "$some" \
  > log 2>&1 || fail "--support:" log
expect log "/cpu/self/template"
expect log "/cpu/self/first"

# What the list says of it.
CEED_PLUGIN_PATH=$PWD/template "$info" > log
expect log "its own: ceed.destroy, restriction.apply; the rest from /cpu/self/ref/serial"
expect log "also asked for as /cpu/self/example"
TEMPLATE_OFF=1 CEED_PLUGIN_PATH=$PWD/template "$info" > log
expect log "not available  TEMPLATE_OFF is set in the environment"

# Its options, in the suite and in a program.
"$info" --plugin template/backend.so --check /cpu/self/template:count --cases '*Restriction*' --verbose > log 2>&1 ||
  fail "with an option:" log
grep -qE '^gathered [1-9][0-9]* values$' log || fail "expected a count above 0 in:" log
status=0
"$info" --plugin template/backend.so --check /cpu/self/template:cuont > log 2>&1 || status=$?
[ $status = 3 ] || fail "a misspelt option gave exit status $status:" log
expect log "Option 'cuont' of /cpu/self/template is unknown"

# Installed, it is found beside the library.
cmake --install template > log 2>&1 || fail "the template does not install:" log
"$info" > log
expect log "ceed-plugins/backend.so)"
"$info" --check /cpu/self/example --cases '*Restriction*' > log || fail "installed:" log
rm "$PREFIX/$LIBDIR/ceed-plugins/backend.so"
echo "$lines lines"
