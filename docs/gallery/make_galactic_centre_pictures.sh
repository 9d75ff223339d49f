#!/usr/bin/env bash
# Renders the pictures of galactic_centre.md at 2k and makes them smaller.  Needs oiiotool.
# Usage, from anywhere: docs/gallery/make_galactic_centre_pictures.sh [domefall] [folder for the frames]
set -euo pipefail
cd "$(dirname "$0")/../.."
show=galactic_centre
domefall=${1:-build/release/domefall}
out=${2:-out/gallery}/$show
# shellcheck source=docs/gallery/mosaic.sh
. docs/gallery/mosaic.sh

mosaic from_the_hole 500,600,640,680,730,930 3x2 420
mosaic from_S2 1220,1360,1440,1500,1560,1700 3x2 420
