#!/usr/bin/env bash
# Renders the pictures of beacon.md at 2k and makes them smaller.  Needs oiiotool.
# Usage, from anywhere: docs/gallery/make_beacon_pictures.sh [domefall] [folder for the frames]
set -euo pipefail
cd "$(dirname "$0")/../.."
domefall=${1:-build/release/domefall}
out=${2:-out/gallery}/beacon

# mosaic NAME FRAMES: eight of them, 320 pixels wide.
mosaic() {
  local name=$1 files=() frame
  "$domefall" render shows/beacon.yaml --size 2k --frames "$2" --out "$out"
  for frame in ${2//,/ }; do
    printf -v picture '%s/graded/beacon_%05d.png' "$out" "$frame"
    oiiotool "$picture" --ch R,G,B --resize 320x320 -o "$out/small_$frame.tif"
    files+=("$out/small_$frame.tif")
  done
  oiiotool "${files[@]}" --mosaic 4x2 --compression jpeg:84 -o "docs/gallery/beacon_$name.jpg"
}

mosaic stays 30,300,600,780,900,990,1080,1170
mosaic follows 1350,1440,1500,1650,1800,2040,2160,2190
