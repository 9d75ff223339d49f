#!/usr/bin/env bash
# Makes the pictures of docs/gallery/look_stars.md.
#
#     docs/gallery/make_look_stars.sh [folder for the frames]
#
#   DOMEFALL          the program                       build/release/domefall
#   DOMEFALL_BEFORE   an older program with its assets  none: the pictures that compare are left as they are
#
# Needs oiiotool.  Frames that are there already are not rendered again.
set -euo pipefail
cd "$(dirname "$0")/../.."
new=$(realpath "${DOMEFALL:-build/release/domefall}")
old=${DOMEFALL_BEFORE:-}
out=${1:-out/look_stars}
gallery=docs/gallery
if [ -z "$old" ]; then echo "set DOMEFALL_BEFORE to compare" >&2; exit 2; fi
old=$(realpath "$old")
mkdir -p "$out"

# strip NAME SHOW FIRST LAST CROP: twelve frames in a row before, and below them the same after.
strip() {
  local name=$1 show=$2 first=$3 last=$4 crop=$5 which
  for which in before after; do
    if [ "$which" = before ]; then program=$old; else program=$new; fi
    "$program" render "shows/$show.yaml" --size 1k --frames "$first-$last" --out "$out/$name-$which" >/dev/null
    local frames=()
    for ((f = first; f <= last; f++)); do
      frames+=("$(printf '%s/graded/%s_%05d.png' "$out/$name-$which" "$show" "$f")")
      frames+=(--ch 'R,G,B' --cut "$crop")
    done
    oiiotool "${frames[@]}" --mosaic:pad=4 6x2 -d uint8 -o "$out/$name-$which.tif"
  done
  oiiotool "$out/$name-before.tif" "$out/$name-after.tif" --mosaic:pad=12 1x2 -d uint8 \
    --compression jpeg:88 -o "$gallery/look_stars_$name.jpg"
}

strip into_the_dark into_the_dark 1074 1085 340x340+190+620
strip flyby flyby 1345 1356 300x340+420+0

# Four thousand pixels: 700 x 500 of them at 100 %, before and after.
for which in before after; do
  if [ "$which" = before ]; then program=$old; else program=$new; fi
  "$program" render shows/into_the_dark.yaml --size 4k --frames 1080 --out "$out/4k-$which" >/dev/null
  oiiotool "$out/4k-$which/graded/into_the_dark_01080.png" --ch R,G,B --cut 700x560+700+2500 -d uint8 \
    -o "$out/4k-$which.tif"
done
oiiotool "$out/4k-before.tif" "$out/4k-after.tif" --mosaic:pad=12 2x1 -d uint8 --compression jpeg:90 \
  -o "$gallery/look_stars_4k.jpg"

# The default sky at 0 EV, 640 x 480 pixels of a dome of 4096 at 100 %, before and after.
cat >"$out/balance.yaml" <<END
title: balance
frames_per_second: 1
size: 4k
camera: {look_at: {ra_deg: 268, dec_deg: -28}, elevation_deg: 60}
timeline: [{duration_s: 1, trajectory: {type: static}}]
END
for which in before after; do
  if [ "$which" = before ]; then program=$old; else program=$new; fi
  "$program" render "$out/balance.yaml" --out "$out/balance-$which" >/dev/null
  oiiotool "$out/balance-$which/graded/balance_00000.png" --ch R,G,B --cut 640x480+1500+2000 -d uint8 \
    -o "$out/balance-$which.tif"
done
oiiotool "$out/balance-before.tif" "$out/balance-after.tif" --mosaic:pad=12 2x1 -d uint8 --compression jpeg:85 \
  -o "$gallery/look_stars_balance.jpg"
