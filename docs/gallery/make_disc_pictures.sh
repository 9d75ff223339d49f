#!/usr/bin/env bash
# Renders the pictures of disc.md at 4k and makes them smaller.  Needs oiiotool.
# Usage, from anywhere: docs/gallery/make_disc_pictures.sh [domefall] [folder for the frames]
set -euo pipefail
cd "$(dirname "$0")/../.."
domefall=${1:-build/release/domefall}
out=${2:-out/gallery}/disc

# The frames from the first to the last, in steps.
strip() {
  local name=$1 first=$2 last=$3 step=$4 files=() frame
  "$domefall" render shows/disc.yaml --size 1k --frames "$first-${last}x$step" --out "$out/strip"
  for frame in $(seq "$first" "$step" "$last"); do
    printf -v picture '%s/strip/graded/disc_%05d.png' "$out" "$frame"
    oiiotool "$picture" --ch R,G,B --resize 320x320 -o "$out/small_$frame.tif"
    files+=("$out/small_$frame.tif")
  done
  oiiotool "${files[@]}" --mosaic 4x2 --compression jpeg:80 -o "docs/gallery/disc_$name.jpg"
}

mkdir -p "$out"
frames=(120 840 1290 1650 1920)
"$domefall" render shows/disc.yaml --size 4k --frames "$(IFS=,; echo "${frames[*]}")" --out "$out"
for frame in "${frames[@]}"; do
  printf -v name 'disc_%05d' "$frame"
  oiiotool "$out/graded/$name.png" --ch R,G,B --resize 700x700 --compression jpeg:84 -o "docs/gallery/$name.jpg"
done
oiiotool "$out/graded/disc_00840.png" --ch R,G,B --cut 1000x700+1500+2400 --compression jpeg:84 \
  -o docs/gallery/disc_crop.jpg
strip plane 960 988 4
strip horizon 1740 1789 7
