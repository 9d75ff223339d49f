#!/usr/bin/env bash
# Renders the pictures of kerr.md.  Needs oiiotool.
# Usage, from anywhere: docs/gallery/make_kerr_pictures.sh [domefall] [folder for the frames]
set -euo pipefail
cd "$(dirname "$0")/../.."
domefall=${1:-build/release/domefall}
out=${2:-out/gallery}/kerr
mkdir -p "$out"

# On a circle of r = 6 in the equator, towards the hole.
spin() {
  cat >"$out/spin_$1.yaml" <<SHOW
size: [1000, 1000]
camera: {projection: rectilinear, fov_deg: 110, look_at: hole}
black_hole: {mass_solar: 1e8, spin: $1}
exposure: {ev: 1}
timeline:
  - {duration_s: 1, trajectory: {type: circular, r: 6.03}}
SHOW
  "$domefall" render "$out/spin_$1.yaml" --frames 0 --out "$out/spin_$1"
}
pictures=()
for a in 0 0.5 0.999; do
  spin "$a"
  pictures+=("$out/spin_$a/graded/spin_${a}_00000.png")
done
oiiotool "${pictures[@]}" --mosaic 3x1 --ch R,G,B --resize 1500x500 --compression jpeg:86 \
  -o docs/gallery/kerr_spins.jpg

# From rest above the ergosphere, through the horizon.
cat >"$out/fall.yaml" <<'SHOW'
size: 2k
black_hole: {mass_solar: 4.3e6, spin: 0.9}
sky: {region_III: {background: grid}}
camera: {look_at: hole, elevation_deg: 45}
timeline:
  - {duration_s: 6, trajectory: {type: infall, rest_r: 6, latitude_deg: 30, to_r: 0.8}}
SHOW
"$domefall" render "$out/fall.yaml" --frames 60,140,165,176 --out "$out/fall"
oiiotool "$out"/fall/graded/fall_00{060,140,165,176}.png --mosaic 2x2 --ch R,G,B --resize 1000x1000 \
  --compression jpeg:84 -o docs/gallery/kerr_fall.jpg

# Discs about three spins, and one that goes against the hole, from 8 degrees above them.
disc() {
  cat >"$out/disc_$1.yaml" <<SHOW
size: [1000, 700]
camera: {projection: rectilinear, fov_deg: 62, look_at: hole}
black_hole: {mass_solar: 1e8, spin: $2}
sky: {region_I: {background: black, stars: {max_magnitude: 5}}}
disc: {outer_r: 16, plunging: true, pattern: turbulence$3}
exposure: {ev: $4}
timeline:
  - {duration_s: 1, trajectory: {type: static, r: 34, latitude_deg: $5}}
SHOW
  "$domefall" render "$out/disc_$1.yaml" --frames 0 --out "$out/disc_$1"
}
disc slow 0.001 '' 0.3 8
disc fast 0.95 '' 0 8
disc against 0.95 ', retrograde: true' 0.3 8
disc pole 0.95 '' 0.3 75
oiiotool "$out"/disc_{slow,fast,against,pole}/graded/*.png --mosaic 2x2 --ch R,G,B --resize 1400x980 \
  --compression jpeg:84 -o docs/gallery/kerr_discs.jpg

# As others saw them.
pictures=()
for show in m87 sgr_a; do
  "$domefall" render "shows/spin/$show.yaml" --frames 0 --out "$out/$show"
  pictures+=("$out/$show/graded/${show}_00000.png")
done
oiiotool "${pictures[@]}" --mosaic 2x1 --ch R,G,B --resize 1200x600 --compression jpeg:84 \
  -o docs/gallery/kerr_event_horizon_telescope.jpg
pictures=()
for a in 0 05 08 095 0999; do
  "$domefall" render "shows/spin/silhouette_$a.yaml" --frames 0 --out "$out/silhouette_$a"
  pictures+=("$out/silhouette_$a/graded/silhouette_${a}_00000.png")
done
oiiotool "${pictures[@]}" --mosaic 5x1 --ch R,G,B --resize 1500x300 --compression jpeg:84 \
  -o docs/gallery/kerr_silhouettes.jpg

# Twelve frames of the production.
frames=(180 600 960 1350 1800 2250 2700 3150 3600 4350 5100 5310)
"$domefall" render shows/the_dragged_sky.yaml --size 1k --frames "$(IFS=,; echo "${frames[*]}")" --out "$out/dragged"
pictures=()
for k in "${frames[@]}"; do
  pictures+=("$(printf '%s/dragged/graded/the_dragged_sky_%05d.png' "$out" "$k")")
done
oiiotool "${pictures[@]}" --mosaic 4x3 --ch R,G,B --resize 1600x1200 --compression jpeg:80 \
  -o docs/gallery/the_dragged_sky_sheet.jpg
