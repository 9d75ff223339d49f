#!/usr/bin/env bash
# Renders look_productions_*.jpg: the three productions at 512 pixels, 24 frames of each, evenly
# spread over its whole length, six in a row.  Needs oiiotool.
# Usage, from anywhere: docs/gallery/make_look_productions.sh [domefall] [folder for the frames]
set -euo pipefail
cd "$(dirname "$0")/../.."
domefall=${1:-build/release/domefall}
out=${2:-out/look}
mkdir -p "$out"
# SHOW FRAMES: how many frames it has.
sheet() {
  local show=$1 count=$2 files=() numbers='' n k
  for k in {0..23}; do numbers+="$(((2 * k + 1) * count / 48)),"; done
  "$domefall" render "shows/$show.yaml" --size 512 --frames "${numbers%,}" --out "$out/$show"
  for n in ${numbers//,/ }; do
    files+=("$out/$show/small_$n.tif")
    oiiotool "$(printf '%s/%s/graded/%s_%05d.png' "$out" "$show" "$show" "$n")" --ch R,G,B -d uint8 \
      --resize 200x200 -o "${files[-1]}"
  done
  oiiotool "${files[@]}" --mosaic 6x4 --compression jpeg:82 -o "docs/gallery/look_productions_$show.jpg"
}
sheet into_the_dark 4306
sheet flyby 3180
sheet kruskal_journey 4148
