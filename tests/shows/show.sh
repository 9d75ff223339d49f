#!/usr/bin/env bash
# show.sh SHOW: the show is checked, and rendered small: first frame, last frame and some between.
source "$(dirname "$0")/../cli/common.bash"
cd "$DOMEFALL_SOURCE"
show=$1
exits 0 "$DOMEFALL" check "$show"
frames=$(sed -nE 's/^frames +([0-9]+).*/\1/p' "$folder/stdout")
step=$(((frames + 4) / 5))
size=128
if grep -qE 'projection: (stereographic|rectilinear)' "$show"; then size=128x128; fi
exits 0 "$DOMEFALL" render "$show" --frames "0-$((frames - 1))x$step,$((frames - 1))" --size $size \
  --out "$folder/frames"
for kind in linear graded; do
  [ -n "$(find "$folder/frames/$kind" -type f)" ] || fail "$show left no $kind frames"
done
