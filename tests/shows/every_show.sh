#!/usr/bin/env bash
# Every show in shows/, shows/paper/ and shows/sky/ is checked and rendered small, first frame, last frame and some between.
# shellcheck source=tests/cli/common.bash
source "$(dirname "$0")/../cli/common.bash"
cd "$DOMEFALL_SOURCE"
count=0
for show in shows/*.yaml shows/paper/*.yaml shows/sky/*.yaml; do
  exits 0 "$DOMEFALL" check "$show"
  frames=$(sed -nE 's/^frames +([0-9]+).*/\1/p' "$folder/stdout")
  name=$(basename "$show" .yaml)
  step=$(((frames + 4) / 5))
  size=128
  if grep -q 'projection: stereographic' "$show"; then size=128x128; fi
  exits 0 "$DOMEFALL" render "$show" --frames "0-$((frames - 1))x$step,$((frames - 1))" --size $size \
    --out "$folder/$name"
  for kind in linear graded; do
    [ -n "$(find "$folder/$name/$kind" -type f)" ] || fail "$show left no $kind frames"
  done
  count=$((count + 1))
done
[ "$count" -ge 5 ] || fail "only $count shows"
