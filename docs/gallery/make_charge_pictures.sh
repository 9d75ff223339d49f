#!/usr/bin/env bash
# Makes the picture of docs/charges.md: the shows of shows/charge/ side by side.  Needs oiiotool.
# Usage, from anywhere: docs/gallery/make_charge_pictures.sh [domefall] [folder for the frames]
set -euo pipefail
cd "$(dirname "$0")/../.."
domefall=${1:-build/release/domefall}
out=${2:-out/charge}

files=()
for show in charge_0 charge_09 charge_1 inside next naked; do
  "$domefall" render "shows/charge/$show.yaml" --out "$out/$show"
  frames=("$out/$show"/graded/*.png)
  oiiotool "${frames[-1]}" --ch R,G,B --resize:filter=blackman-harris 480x0 -o "$out/$show.tif"
  files+=("$out/$show.tif")
done
oiiotool "${files[@]}" --mosaic:pad=4 3x2 --compression jpeg:86 -o docs/gallery/charge_figures.jpg
