#!/usr/bin/env bash
# Renders the pictures of disc.md at 4k and makes them smaller.  Needs oiiotool.
# Usage, from anywhere: docs/gallery/make_disc_pictures.sh [domefall] [folder for the frames]
set -euo pipefail
cd "$(dirname "$0")/../.."
domefall=${1:-build/release/domefall}
out=${2:-out/gallery}/disc

# The frames of a show from the first to the last, in steps, small and side by side.
strip() {
  local show=$1 name=$2 first=$3 last=$4 step=$5 files=() frame
  "$domefall" render "shows/$show.yaml" --size 1k --frames "$first-${last}x$step" --out "$out/$show"
  for frame in $(seq "$first" "$step" "$last"); do
    printf -v picture '%s/%s/graded/%s_%05d.png' "$out" "$show" "$show" "$frame"
    oiiotool "$picture" --ch R,G,B --resize 320x320 -o "$out/small_$frame.tif"
    files+=("$out/small_$frame.tif")
  done
  oiiotool "${files[@]}" --mosaic 4x2 --compression jpeg:80 -o "docs/gallery/$name.jpg"
}

# Frames of a show, as they are on the dome.
pictures() {
  local show=$1 frame name
  shift
  "$domefall" render "shows/$show.yaml" --size 4k --frames "$(IFS=,; echo "$*")" --out "$out/4k_$show"
  for frame in "$@"; do
    printf -v name '%s_%05d' "$show" "$frame"
    oiiotool "$out/4k_$show/graded/$name.png" --ch R,G,B --resize 700x700 --compression jpeg:84 \
      -o "docs/gallery/$name.jpg"
  done
}

# A picture on a flat screen, from r, of a show whose other sections come in.
still() {
  local name=$1 size=$2 fov=$3 r=$4
  cat >"$out/$name.yaml.head" <<SHOW
size: [$size]
camera: {projection: rectilinear, fov_deg: $fov, look_at: hole}
timeline:
  - {duration_s: 1, trajectory: {type: static, r: $r}}
SHOW
  cat "$out/$name.yaml.head" - >"$out/$name.yaml"
  "$domefall" render "$out/$name.yaml" --frames 0 --out "$out/$name"
}

mkdir -p "$out"
pictures disc 70 653 1290 1650 1920
oiiotool "$out/4k_disc/graded/disc_00653.png" --ch R,G,B --cut 1000x700+1500+2400 --compression jpeg:84 \
  -o docs/gallery/disc_crop.jpg
strip disc disc_plane 857 885 4
strip disc disc_horizon 1740 1789 7

pictures close_to_the_fire 1380 1950 3000 4020 4740
strip close_to_the_fire close_to_the_fire_sheet 450 4825 625
strip close_to_the_fire close_to_the_fire_plane 1736 1792 8

# A halo and jets around the hole alone.
gas() {
  still "$1" '900, 700' 50 40 <<SHOW
black_hole: {mass_solar: 6.5e9}
$2
SHOW
}
gas halo 'halo: {inclination_deg: 70, t_k: 3500}'
gas jet 'jet: {inclination_deg: 25, t_k: 9000}'
oiiotool "$out"/{halo/graded/halo,jet/graded/jet}_00000.png --mosaic 2x1 --ch R,G,B \
  --resize 1000x389 --compression jpeg:86 -o docs/gallery/disc_halo_jet.jpg

# As the film's renderer had it, and with its shifts of frequency left out, as in the film.
film() {
  still "$1" '1600, 800' 46 74.1 <<SHOW
black_hole: {mass_solar: 1e8}
disc: {inclination_deg: 3.44, inner_r: 9.26, outer_r: 18.7, t_max_k: 4500}
exposure: {ev: -0.5}
stars: {min_sigma_deg: 0.03}
effects: $2
SHOW
}
film film '{doppler_colour: false, intensity: false}'
film whole '{}'
oiiotool "$out"/{film/graded/film,whole/graded/whole}_00000.png --mosaic 1x2 --ch R,G,B \
  --resize 1000x1000 --compression jpeg:86 -o docs/gallery/disc_dngr.jpg
