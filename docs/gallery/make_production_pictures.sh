#!/usr/bin/env bash
# Renders the pictures of productions.md at 4k and makes them smaller.  Needs oiiotool.
# Usage, from anywhere: docs/gallery/make_production_pictures.sh [domefall] [folder for the frames]
set -euo pipefail
cd "$(dirname "$0")/../.."
domefall=${1:-build/release/domefall}
out=${2:-out/gallery}

# SHOW SECONDS...: the frames at those seconds (30 in each), and how long they took.
render() {
  local show=$1 frames second
  shift
  frames=$(for second in "$@"; do awk -v s="$second" 'BEGIN { printf "%d,", s * 30 }'; done)
  "$domefall" render "shows/$show.yaml" --size 4k --frames "${frames%,}" --out "$out/$show" --explain
}

picture() { printf '%s/%s/graded/%s_%05d.png' "$out" "$1" "$1" "$(awk -v s="$2" 'BEGIN { print int(s * 30) }')"; }

# SHOW SECONDS...: twelve frames, four in a row, 400 pixels each.
sheet() {
  local show=$1 files=() second
  shift
  for second in "$@"; do
    oiiotool "$(picture "$show" "$second")" --ch R,G,B --resize 400x400 -o "$out/small_$second.tif"
    files+=("$out/small_$second.tif")
  done
  oiiotool "${files[@]}" --mosaic 4x3 --compression jpeg:80 -o "docs/gallery/${show}_sheet.jpg"
}

# SHOW SECOND
single() {
  oiiotool "$(picture "$1" "$2")" --ch R,G,B --resize 700x700 --compression jpeg:84 -o "docs/gallery/$1_$2s.jpg"
}

dark=(8 24 36 56 70 86 100 110 118 122 128 137)
flyby=(8 16 22 27 34 41 47 56 67 76 86 98)
kruskal=(5 10 13 16 22 30 36 58 64 86 93 124)
back=(8 22 36 48 62 68 71 75 84 98 108 115)
next=(8 24 40 52 54 59 67 83 90 97 104 114)
mkdir -p "$out"
render into_the_dark "${dark[@]}"
render flyby "${flyby[@]}"
render kruskal_journey "${kruskal[@]}"
render there_and_back "${back[@]}"
render next_universe "${next[@]}"
sheet into_the_dark "${dark[@]}"
sheet flyby "${flyby[@]}"
sheet kruskal_journey "${kruskal[@]}"
sheet there_and_back "${back[@]}"
sheet next_universe "${next[@]}"
for second in 56 86 128; do single into_the_dark "$second"; done
for second in 27 56 86; do single flyby "$second"; done
for second in 13 64 93; do single kruskal_journey "$second"; done
for second in 48 71 84; do single there_and_back "$second"; done
for second in 67 90 114; do single next_universe "$second"; done

"$domefall" render shows/horizon_strip.yaml --size 4k --out "$out/horizon_strip"
strip=()
for n in 0 1 2 3; do
  oiiotool "$out/horizon_strip/graded/horizon_strip_0000$n.png" --ch R,G,B --resize 400x400 -o "$out/strip_$n.tif"
  strip+=("$out/strip_$n.tif")
done
oiiotool "${strip[@]}" --mosaic 4x1 --compression jpeg:84 -o docs/gallery/horizon_strip.jpg
