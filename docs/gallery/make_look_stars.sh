#!/usr/bin/env bash
# Makes the pictures of docs/gallery/look_stars.md.  Needs oiiotool.
# Usage, from anywhere: docs/gallery/make_look_stars.sh [domefall] [folder for the frames]
# Frames that are there already are not rendered again.
set -euo pipefail
cd "$(dirname "$0")/../.."
domefall=$(realpath "${1:-build/release/domefall}")
out=${2:-out/look_stars}
gallery=docs/gallery
mkdir -p "$out"

# Antares passes behind the hole, by two fifths of a degree a frame.
cat >"$out/passage.yaml" <<END
title: passage
frames_per_second: 30
size: 1k
black_hole: {mass_solar: 4.3e6, at: {ra_deg: 244.67, dec_deg: -26.43}}
camera: {look_at: hole, elevation_deg: 55}
sky: {region_I: {stars: naked_eye}}
timeline: [{duration_s: 30, trajectory: {type: circular, r: 12, orbits: 1}}]
END
"$domefall" render "$out/passage.yaml" --frames 0-11 --out "$out/passage"
frames=()
for f in {0..11}; do
  frames+=("$(printf '%s/passage/graded/passage_%05d.png' "$out" "$f")" --ch 'R,G,B' --cut 540x540+240+450
    --resize 270x270)
done
oiiotool "${frames[@]}" --mosaic:pad=4 6x2 -d uint8 --compression jpeg:84 -o "$gallery/look_stars_passage.jpg"

"$domefall" render "$out/passage.yaml" --size 4k --frames 5 --out "$out/4k"
oiiotool "$out/4k/graded/passage_00005.png" --ch R,G,B --cut 700x560+960+2300 -d uint8 --compression jpeg:86 \
  -o "$gallery/look_stars_4k.jpg"

# The default sky at 0 EV, 640 x 480 pixels of a dome of 4096 at 100 %.
cat >"$out/balance.yaml" <<END
title: balance
frames_per_second: 1
size: 4k
camera: {look_at: {ra_deg: 268, dec_deg: -28}, elevation_deg: 60}
timeline: [{duration_s: 1, trajectory: {type: static}}]
END
"$domefall" render "$out/balance.yaml" --out "$out/balance"
oiiotool "$out/balance/graded/balance_00000.png" --ch R,G,B --cut 640x480+1500+2000 -d uint8 \
  --compression jpeg:85 -o "$gallery/look_stars_balance.jpg"
