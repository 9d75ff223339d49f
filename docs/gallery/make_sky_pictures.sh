#!/usr/bin/env bash
# Makes the pictures of docs/gallery/sky.md from the shows in shows/sky/, and prints what that page says was measured.
#
#     docs/gallery/make_sky_pictures.sh [folder for the frames]
#
#   DOMEFALL          the program                                       build/release/domefall
#   DOMEFALL_BEFORE   an older program to compare it with               none: such pictures are left as they are
#   TYCHO2            tycho2.stars (shows/assets/fetch_stars 2.5m)      shows/sky/tycho2.stars, fetched if it is not there
#
# Needs oiiotool, and 4 GB for the frames.  Frames that are there already are not rendered again.
set -euo pipefail
cd "$(dirname "$0")/../.."
new=$(realpath "${DOMEFALL:-build/release/domefall}")
old=${DOMEFALL_BEFORE:-}
out=${1:-out/sky}
gallery=docs/gallery
[ -z "$old" ] || old=$(realpath "$old")
if [ -z "${TYCHO2:-}" ]; then
  TYCHO2=shows/sky/tycho2.stars
  [ -f "$TYCHO2" ] || DOMEFALL=$new shows/assets/fetch_stars 2.5m shows/sky
fi
TYCHO2=$(realpath "$TYCHO2")
mkdir -p "$out/shows" "$out/parts"

# render NAME SHOW PROGRAM [OPTIONS]: into $out/NAME.
render() {
  local name=$1 show=$2 program=$3
  shift 3
  "$program" render "$show" --size 4k "$@" --out "$out/$name"
}

# variant NAME SHOW SED: a copy of shows/sky/SHOW.yaml with a change.
variant() {
  sed "$3" "shows/sky/$2.yaml" >"$out/shows/$1.yaml"
  if cmp -s "shows/sky/$2.yaml" "$out/shows/$1.yaml"; then echo "$1: nothing changed in $2" >&2; exit 1; fi
  printf '%s' "$out/shows/$1.yaml"
}

graded() { printf '%s/%s/graded/%s_%05d.png' "$out" "$1" "$2" "$3"; }
linear() { printf '%s/%s/linear/%s_%05d.exr' "$out" "$1" "$2" "$3"; }

parts=()
# Adds a tile to the next picture: crop FILE WIDTHxHEIGHT+X+Y ZOOM, whole FILE WIDTH
crop() {
  local size=${2%%+*} part
  part=$out/parts/$(printf '%03d' ${#parts[@]}).tif
  oiiotool "$1" --ch R,G,B --cut "$2" --resize:filter=box "$((${size%x*} * $3))x$((${size#*x} * $3))" -d uint8 -o "$part"
  parts+=("$part")
}
whole() {
  local part
  part=$out/parts/$(printf '%03d' ${#parts[@]}).tif
  oiiotool "$1" --ch R,G,B --resize:filter=blackman-harris "$2x$2" -d uint8 -o "$part"
  parts+=("$part")
}
# The change from one frame to the next, four times, about a middle grey.
change() {
  local size=${3%%+*} part
  part=$out/parts/$(printf '%03d' ${#parts[@]}).tif
  oiiotool "$2" --ch R,G,B --cut "$3" "$1" --ch R,G,B --cut "$3" --sub --mulc 4 --addc 0.5 --clamp:min=0:max=1 \
    --resize:filter=box "$((${size%x*} * $4))x$((${size#*x} * $4))" -d uint8 -o "$part"
  parts+=("$part")
}
# Puts the tiles together: picture NAME COLUMNSxROWS QUALITY
picture() {
  oiiotool "${parts[@]}" --mosaic "$2" --compression "jpeg:$3" -o "$gallery/$1.jpg"
  parts=()
}

# ---- the silhouette, and a slow pan ----

silhouette() {
  crop "$(graded "pan_$1" slow_pan 0)" 100x50+2000+2410 8
  crop "$(graded "first_light_$1" first_light 136)" 100x50+2000+2540 8
}

pan() {
  local frame place
  for place in 100x60+1880+2390 100x60+2900+1180; do
    for frame in 0 1 2 3 4; do crop "$(graded "pan_$1" slow_pan $frame)" "$place" 3; done
    for frame in 0 1 2 3 4; do
      change "$(graded "pan_$1" slow_pan $frame)" "$(graded "pan_$1" slow_pan $((frame + 1)))" "$place" 3
    done
  done
}

# The light of isolated stars and their brightest pixels in the second half of the pan: "light 1.0002 pixel 1.13".
steadiness() {
  local place frame
  for place in "${stars[@]}"; do
    for frame in 6 7 8 9 10 11; do
      oiiotool "$(linear "pan_$1" slow_pan $frame)" --ch R,G,B --cut "53x53+$place" --printstats
    done | awk -v place="$place" '
      /Stats Max/ { peak = $3 + $4 + $5; if (!p || peak < low_p) low_p = peak; if (peak > p) p = peak }
      /Stats Avg/ { light = $3 + $4 + $5; if (!l || light < low_l) low_l = light; if (light > l) l = light }
      END { printf "  %s light %.4f brightest pixel %.3f\n", place, l / low_l, p / low_p }'
  done
}
stars=(588+1584 2642+1947 3640+1990 3222+2496 3106+1832)

# ---- all pictures ----

render pan_new shows/sky/slow_pan.yaml "$new"
render first_light_new shows/first_light.yaml "$new" --frames 136
render extremes_new shows/sky/extremes.yaml "$new"
tycho=$(variant extremes_tycho extremes "s|catalogue: naked_eye, max_magnitude: 6.5|catalogue: $TYCHO2, max_magnitude: 11|")
render extremes_tycho "$tycho" "$new"
echo "steadiness: largest over smallest of six frames"
steadiness new

if [ -n "$old" ]; then
  render pan_old shows/sky/slow_pan.yaml "$old"
  render first_light_old shows/first_light.yaml "$old" --frames 136
  render extremes_old shows/sky/extremes.yaml "$old"
  echo "steadiness before"
  steadiness old
  silhouette old
  silhouette new
  picture sky_silhouette 2x2 86
  pan old
  picture sky_pan_before 5x4 86
  crop "$(graded extremes_old extremes 0)" 500x400+1800+1150 1
  crop "$(graded extremes_new extremes 0)" 500x400+1800+1150 1
  crop "$(graded extremes_tycho extremes_tycho 0)" 500x400+1800+1150 1
  crop "$(graded extremes_old extremes 1)" 500x400+1800+1250 1
  crop "$(graded extremes_new extremes 1)" 500x400+1800+1250 1
  crop "$(graded extremes_tycho extremes_tycho 1)" 500x400+1800+1250 1
  picture sky_extremes_crops 3x2 84
fi
pan new
picture sky_pan 5x4 80
for frame in 0 1; do
  whole "$(graded extremes_new extremes $frame)" 700
  whole "$(graded extremes_tycho extremes_tycho $frame)" 700
done
picture sky_extremes 2x2 80

# The file stands beside the show that names it.
[ -f "$out/shows/tycho_milky_way.sky" ] || "$new" sky build --stars "$TYCHO2" --out "$out/shows/tycho_milky_way.sky"
thermal=$(variant fast_thermal fast_milky_way 's|background: milky_way|background: ./tycho_milky_way.sky|')
render fast_milky_way shows/sky/fast_milky_way.yaml "$new"
render fast_thermal "$thermal" "$new"
for name in fast_milky_way fast_thermal; do
  for frame in 0 1 2; do whole "$(graded $name $name $frame)" 480; done
done
picture sky_milky_way 3x2 82

still=$(variant shutter_closed shutter '/^exposure:/d')
render shutter shows/sky/shutter.yaml "$new" --frames 30
render shutter_closed "$still" "$new" --frames 30
for name in shutter_closed shutter; do whole "$(graded $name $name 30)" 700; done
for name in shutter_closed shutter; do crop "$(graded $name $name 30)" 700x700+600+1750 1; done
picture sky_shutter 2x2 82

laws=("size 10" "psf 10" "size 0" "psf 0")
for law in "${laws[@]}"; do
  read -r kind core <<<"$law"
  show=$(variant "blobs_${kind}_$core" blobs "s/^stars:.*/stars: {law: $kind, white_core: $core}/")
  render "blobs_${kind}_$core" "$show" "$new"
done
for place in "0 400x400+1800+2300" "1 400x400+1500+1200"; do
  for law in "${laws[@]}"; do
    name=blobs_${law/ /_}
    crop "$(graded "$name" "$name" "${place%% *}")" "${place#* }" 1
  done
done
picture sky_blobs 4x2 84
