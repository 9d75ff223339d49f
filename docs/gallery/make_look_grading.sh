#!/usr/bin/env bash
# Renders the pictures of look_blacks.md and look_grading.md.  Needs oiiotool.
# Usage, from anywhere: docs/gallery/make_look_grading.sh [domefall] [folder]
set -euo pipefail
cd "$(dirname "$0")/../.."
domefall=${1:-build/release/domefall}
out=${2:-out/look}
mkdir -p "$out"

displays=("Dome G2.2 Rec.709" "Dome G2.4 Rec.709" "sRGB - Display" "Dome G2.6 P3-D65" "Dome G2.6 DCI-P3"
  "Dome G2.4 Rec.2020")
views=("Dome" "ACES SDR" "Star field" "Un-tone-mapped")

# NAME DISPLAY VIEW [STARS]: a show of the heart of the Milky Way behind a hole; the lines below are
# all that it says.
show() {
  cat >"$out/$1.yaml" <<END
title: $1
size: 1k
black_hole: {mass_solar: 4.3e6}
camera: {look_at: hole, elevation_deg: 50}
sky: {region_I: {stars: ${4:-naked_eye}}}
grade: {display: "$2", view: "$3"}
timeline: [{duration_s: 1, trajectory: {type: static, r: 30}}]
END
}
# NAME: the graded frame of such a show, which is rendered once and regraded after that.
picture() { printf '%s/frames_%s/graded/%s_00000.png' "$out" "$1" "$1"; }
frame() { "$domefall" render "$out/$1.yaml" --frames 0 --out "$out/frames_$1"; }

# One frame under all displays and views: a row for each display, a column for each view.
tiles=()
for d in "${!displays[@]}"; do
  for v in "${!views[@]}"; do
    name=look_${d}_$v
    show "$name" "${displays[d]}" "${views[v]}"
    frame "$name"
    oiiotool "$(picture "$name")" --ch R,G,B -d uint8 --resize 240x240 -o "$out/$name.tif"
    tiles+=("$out/$name.tif")
  done
done
oiiotool "${tiles[@]}" --mosaic "${#views[@]}x${#displays[@]}" --compression jpeg:80 \
  -o docs/gallery/look_displays.jpg

# Each view by itself.
for v in "${!views[@]}"; do
  name=$(tr 'A-Z ' 'a-z_' <<<"${views[v]}" | tr -d -)
  oiiotool "$(picture "look_0_$v")" --ch R,G,B -d uint8 --cut 640x480+192+420 --compression jpeg:86 \
    -o "docs/gallery/look_view_$name.jpg"
done

# The default sky without a hole: whole, and at 100 %.
cat >"$out/default_sky.yaml" <<END
title: default_sky
size: 1k
camera: {look_at: {ra_deg: 266.405, dec_deg: -28.936}}
timeline: [{duration_s: 1}]
END
"$domefall" render "$out/default_sky.yaml" --frames 0 --out "$out/default_sky"
sky="$out/default_sky/graded/default_sky_00000.png"
oiiotool "$sky" --ch R,G,B -d uint8 --resize 500x500 --compression jpeg:84 -o docs/gallery/look_blacks.jpg
oiiotool "$sky" --ch R,G,B -d uint8 --cut 500x500+260+380 --compression jpeg:86 -o docs/gallery/look_blacks_crop.jpg
