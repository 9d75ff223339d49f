#!/usr/bin/env bash
# Renders the pictures of galactic_centre.md at 2k and makes them smaller.  Needs oiiotool.
# Usage, from anywhere: docs/gallery/make_galactic_centre_pictures.sh [domefall] [folder for the frames]
set -euo pipefail
cd "$(dirname "$0")/../.."
domefall=${1:-build/release/domefall}
out=${2:-out/gallery}/galactic_centre

# mosaic NAME FRAMES: six of them, 420 pixels wide.
mosaic() {
  local name=$1 files=() frame
  "$domefall" render shows/galactic_centre.yaml --size 2k --frames "$2" --out "$out"
  for frame in ${2//,/ }; do
    printf -v picture '%s/graded/galactic_centre_%05d.png' "$out" "$frame"
    oiiotool "$picture" --ch R,G,B --resize 420x420 -o "$out/small_$frame.tif"
    files+=("$out/small_$frame.tif")
  done
  oiiotool "${files[@]}" --mosaic 3x2 --compression jpeg:84 -o "docs/gallery/galactic_centre_$name.jpg"
}

mosaic from_the_hole 780,870,900,930,980,1080
mosaic from_S2 1220,1360,1440,1500,1560,1700
