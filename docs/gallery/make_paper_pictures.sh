#!/usr/bin/env bash
# Makes the pictures of docs/gallery/paper.md: every frame of the shows in shows/paper/ (or of the ones
# named), rendered at its full size, made smaller and saved as docs/gallery/LABEL_FRAME.jpg.
#
#     docs/gallery/make_paper_pictures.sh [LABEL...]
#
# The filter has no negative lobes, which would draw dark rings around bright stars.
#
# Needs build/release/domefall (or $DOMEFALL) and oiiotool.  Frames stay in out/paper/.
set -euo pipefail
cd "$(dirname "$0")/../.."
domefall=${DOMEFALL:-build/release/domefall}
width=700 quality=88

labels=("$@")
if [ ${#labels[@]} = 0 ]; then
  for show in shows/paper/*.yaml; do labels+=("$(basename "$show" .yaml)"); done
fi

for label in "${labels[@]}"; do
  out=out/paper/$label
  "$domefall" render "shows/paper/$label.yaml" --out "$out"
  for frame in "$out"/graded/*.png; do
    number=$(basename "$frame" .png | grep -oE '[0-9]+$')
    oiiotool "$frame" --resize:filter=blackman-harris "${width}x0" -d uint8 \
      --compression "jpeg:$quality" -o "docs/gallery/${label}_$number.jpg"
  done
done
