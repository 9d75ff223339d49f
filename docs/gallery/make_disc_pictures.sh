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
frames=(70 653 1290 1650 1920)
"$domefall" render shows/disc.yaml --size 4k --frames "$(IFS=,; echo "${frames[*]}")" --out "$out"
for frame in "${frames[@]}"; do
  printf -v name 'disc_%05d' "$frame"
  oiiotool "$out/graded/$name.png" --ch R,G,B --resize 700x700 --compression jpeg:84 -o "docs/gallery/$name.jpg"
done
oiiotool "$out/graded/disc_00653.png" --ch R,G,B --cut 1000x700+1500+2400 --compression jpeg:84 \
  -o docs/gallery/disc_crop.jpg
strip plane 857 885 4
strip horizon 1740 1789 7

# As the film's renderer had it, and with its shifts of frequency left out, as in the film.
view() {
  local name=$1 effects=$2
  cat >"$out/$name.yaml" <<SHOW
size: [1600, 800]
black_hole: {mass_solar: 1e8}
disc: {inclination_deg: 3.44, inner_r: 9.26, outer_r: 18.7, t_max_k: 4500}
exposure: {ev: -0.5}
stars: {min_sigma_deg: 0.03}
effects: $effects
camera: {projection: rectilinear, fov_deg: 46, look_at: hole}
timeline:
  - {duration_s: 1, trajectory: {type: static, r: 74.1}}
SHOW
  "$domefall" render "$out/$name.yaml" --frames 0 --out "$out/$name"
}
view film '{doppler_colour: false, intensity: false}'
view whole '{}'
oiiotool "$out"/{film/graded/film,whole/graded/whole}_00000.png --mosaic 1x2 --ch R,G,B \
  --resize 1000x1000 --compression jpeg:86 -o docs/gallery/disc_dngr.jpg
