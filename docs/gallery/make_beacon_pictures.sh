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

mosaic stays 30,300,600,780,900,990,1080,1170 4x2 320
mosaic follows 1350,1440,1500,1650,1800,2040,2160,2190 4x2 320
