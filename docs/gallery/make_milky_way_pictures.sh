#!/usr/bin/env bash
# Makes the pictures of docs/gallery/look_milky_way.md: parts of the sky as two programs show them, the one on the left
# with its own maps and stars, the one on the right with those of this tree.
#
#     DOMEFALL_BEFORE=older/domefall docs/gallery/make_milky_way_pictures.sh
#
# Needs build/release/domefall (or $DOMEFALL) and oiiotool.  Frames stay in out/look_milky_way/.
set -euo pipefail
cd "$(dirname "$0")/../.."
after=${DOMEFALL:-build/release/domefall}
before=${DOMEFALL_BEFORE:?names the older program}
out=out/look_milky_way
mkdir -p "$out"

# pair NAME: both programs' frames of out/NAME.yaml, side by side.
pair() {
  local name=$1
  "$before" render "$out/$name.yaml" --out "$out/before/$name"
  "$after" render "$out/$name.yaml" --out "$out/after/$name"
  oiiotool "$out/before/$name/graded/${name}_00000.png" --resize:filter=blackman-harris 640x0 \
    "$out/after/$name/graded/${name}_00000.png" --resize:filter=blackman-harris 640x0 \
    --mosaic:pad=8 2x1 -d uint8 --compression jpeg:70 -o "docs/gallery/look_milky_way_$name.jpg"
}

# view NAME RA DEC DEGREES: a part of the sky.
view() {
  cat >"$out/$1.yaml" <<END
title: $1
frames_per_second: 1
size: [960, 960]
camera: {projection: stereographic, fov_deg: $4, look_at: {ra_deg: $2, dec_deg: $3}}
exposure: {ev: 1}
timeline: [{duration_s: 1, trajectory: {type: static}}]
END
  pair "$1"
}
view bulge 268 -27 60
view carina 163 -60 24
view large_cloud 78 -69.5 20
view small_cloud 13 -73 12
view orion 84 0 40
view cygnus 308 40 45

cat >"$out/sky.yaml" <<END
title: sky
frames_per_second: 1
size: 2k
camera: {look_at: {ra_deg: 268, dec_deg: -28}, elevation_deg: 60}
exposure: {ev: 1}
timeline: [{duration_s: 1, trajectory: {type: static}}]
END
pair sky
cp shows/paper/APOD.yaml "$out/APOD.yaml"
sed -i "s|\.\./assets|$PWD/shows/assets|" "$out/APOD.yaml"
sed -i 's/^title: .*/title: APOD/' "$out/APOD.yaml"
pair APOD
