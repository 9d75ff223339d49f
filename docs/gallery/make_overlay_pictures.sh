#!/usr/bin/env bash
# Makes overlay_marks.jpg, of ../overlays.md, and layers.jpg, of ../compositing.md.  Needs oiiotool.
# Usage, from anywhere: docs/gallery/make_overlay_pictures.sh [domefall] [folder for the frames]
set -euo pipefail
cd "$(dirname "$0")/../.."
domefall=$(realpath "${1:-build/release/domefall}")
out=${2:-out/overlays}
mkdir -p "$out"

cat >"$out/marks.yaml" <<END
title: marks
frames_per_second: 10
size: 1k
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {stars: {max_magnitude: 7}}}
timeline: [{duration_s: 1, trajectory: {type: circular, r: 12, orbits: 0.05}}]
END
"$domefall" render "$out/marks.yaml" --frames 5 --out "$out/marks" \
  --overlay grid,rim,safe_area,sweet_spot,silhouette,einstein_ring,star_names,burn_in
oiiotool "$out/marks/graded/marks_00005.png" --ch R,G,B -d uint8 --resize 680x680 --compression jpeg:84 \
  -o docs/gallery/overlay_marks.jpg

# Sky, stars, disc and the disc's alpha of one frame, seen through the view of graded frames.
frame=layered_00300
sed 's/^size:.*/size: 1k/' shows/disc.yaml >"$out/layered.yaml"
echo 'output: {layers: [sky, stars, disc], layer_files: true, graded: none}' >>"$out/layered.yaml"
"$domefall" render "$out/layered.yaml" --frames 300 --out "$out/layered"
for layer in sky stars disc; do
  oiiotool --colorconfig shows/assets/dome.ocio "$out/layered/layers/$layer/$frame.exr" --ch R,G,B \
    --iscolorspace ACEScg --ociodisplay "Dome G2.2 Rec.709" Dome --resize 500x500 -d uint8 -o "$out/$layer.tif"
done
oiiotool "$out/layered/layers/disc/$frame.exr" --ch A,A,A --chnames R,G,B --resize 500x500 -d uint8 -o "$out/alpha.tif"
oiiotool "$out/sky.tif" "$out/stars.tif" "$out/disc.tif" "$out/alpha.tif" --mosaic 2x2 --compression jpeg:82 \
  -o docs/gallery/layers.jpg
