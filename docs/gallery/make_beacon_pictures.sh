#!/usr/bin/env bash
# Renders the pictures of beacon.md at 2k and makes them smaller.  Needs oiiotool.
# Usage, from anywhere: docs/gallery/make_beacon_pictures.sh [domefall] [folder for the frames]
set -euo pipefail
cd "$(dirname "$0")/../.."
show=beacon
domefall=${1:-build/release/domefall}
out=${2:-out/gallery}/$show
# shellcheck source=docs/gallery/mosaic.sh
. docs/gallery/mosaic.sh

mosaic stays 45,300,600,720,780,840,900,960 4x2 320
mosaic follows 1050,1170,1290,1410,1590,1770,1815,2010 4x2 320
