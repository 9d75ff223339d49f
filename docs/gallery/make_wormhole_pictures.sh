#!/usr/bin/env bash
# Makes the picture of docs/wormholes.md: the shows of shows/wormhole/ side by side.  Needs oiiotool.
# Usage, from anywhere: docs/gallery/make_wormhole_pictures.sh [domefall] [folder for the frames]
set -euo pipefail
cd "$(dirname "$0")/../.."
domefall=${1:-build/release/domefall}
out=${2:-out/wormhole}

files=()
for show in length_001 length_1 length_10 width_0014 width_043; do
  "$domefall" render "shows/wormhole/$show.yaml" --out "$out/$show"
  oiiotool "$out/$show/graded/${show}_00000.png" --ch R,G,B --resize:filter=blackman-harris 480x0 -o "$out/$show.tif"
  files+=("$out/$show.tif")
done
oiiotool "${files[@]}" --mosaic:pad=4 3x2 --compression jpeg:86 -o docs/gallery/wormhole_figures.jpg
