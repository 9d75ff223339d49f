#!/usr/bin/env bash
# The ten-line show of the README is ten lines long and does what it says.
source "$(dirname "$0")/common.bash"
awk '/^    title: /, /^$/' "$DOMEFALL_SOURCE/README.md" | sed 's/^    //; /^$/d' >around.yaml
[ "$(wc -l <around.yaml)" -eq 10 ] || fail "not ten lines"
exits 0 "$DOMEFALL" check around.yaml
grep -q '^frames  *750 ' stdout || fail "other frames than 750"
exits 0 "$DOMEFALL" render around.yaml --frames 0,749 --size 64
for file in linear/around_00000.exr graded/around_00749.tif; do
  [ -s "out/around/$file" ] || fail "no $file"
done
