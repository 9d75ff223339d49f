#!/usr/bin/env bash
# Pixels that are not square, in all files that are made of a show.
source "$(dirname "$0")/common.bash"

cat >wide.yaml <<END
title: Wide pixels
frames_per_second: 4
size: [180, 144]
camera: {projection: rectilinear, fov_deg: 90}
output: {pixel_aspect: 16:11, layers: [sky, stars], layer_files: true}
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {background: grid, stars: naked_eye}}
timeline: [{duration_s: 0.5, trajectory: {type: static, r: 12}}]
END
exits 0 "$DOMEFALL" render wide.yaml --out made
exits 0 "$DOMEFALL" render wide.yaml --lens-map --frames 0 --out made
for exr in made/linear/wide_00000.exr made/layers/sky/wide_00000.exr made/lens/wide_00000.exr; do
  oiiotool --info -v "$exr" | grep -q 'PixelAspectRatio: 1.4545' || fail "the pixels of $exr are square"
done
oiiotool --info -v made/graded/wide_00000.png >facts
[ "$(grep -Eo '[XY]Resolution: .*' facts | tr '\n' ' ')" = 'XResolution: 11 YResolution: 16 ' ] || fail "$(cat facts)"

# A point on the picture's lower edge, 11/20 of the width of view below its middle, is there to Nuke.
oiiotool --info -v made/linear/wide_00000.exr >facts
python3 - facts <<'END'
import re, sys
m = [float(x) for x in re.search(r"worldToNDC: ([-0-9., e]+)", open(sys.argv[1]).read())[1].split(",")]
x, y, _, w = [sum(p * m[4 * k + c] for k, p in enumerate([0, -11 / 20, -1, 1])) for c in range(4)]
assert abs(x / w - 0.5) < 1e-6 and abs(y / w - 1) < 1e-6, m
END

# A second run finds its frames, and other pixels are another version of them.
exits 0 "$DOMEFALL" render wide.yaml --out made
says '^0 frames made, 2 already there'
mkdir other
sed 's/16:11/12:11/' wide.yaml >other/wide.yaml
exits 0 "$DOMEFALL" render other/wide.yaml --out made
says '^2 frames made'
exits 0 "$DOMEFALL" render wide.yaml --out made

# Cameras of other programs have the picture's shape on the screen: 180 x 144 x 11/16 = 180 x 99.
exits 0 "$DOMEFALL" states wide.yaml --format usda
grep -q '^ *float verticalAperture = 19.8$' stdout || fail "$(grep Aperture stdout)"
exits 0 "$DOMEFALL" states wide.yaml --format chan
[ "$(awk 'NR == 1 {printf "%.4f", $8}' stdout)" = 57.6216 ] || fail "$(cat stdout)"
exits 0 "$DOMEFALL" states wide.yaml --format json
grep -q '"pixel_aspect":1.4545454545454546' <(tr -d ' ' <stdout) || fail "$(head -c 300 stdout)"

# A sheet shows them as a screen does.
exits 0 "$DOMEFALL" sheet wide.yaml --from made --frames 0 --out sheet.png
oiiotool --info -v sheet.png >facts
grep -q Resolution facts && fail "the pixels of a sheet are not square"
[[ $(oiiotool --info sheet.png) =~ 204\ x\ +181, ]] || fail "$(oiiotool --info sheet.png)"

sed 's/rectilinear, fov_deg: 90/domemaster/; s/\[180, 144\]/64/' wide.yaml >dome.yaml
exits 2 "$DOMEFALL" check dome.yaml
says 'output.pixel_aspect goes with the projections fisheye, stereographic and rectilinear'

command -v ffmpeg >/dev/null || exit 0
for preset in review master; do
  exits 0 "$DOMEFALL" movie wide.yaml --preset "$preset" --from made --out "$preset.${movie:=mp4}"
  [ "$(ffprobe -v error -show_entries stream=sample_aspect_ratio -of csv=p=0 "$preset.$movie")" = 16:11 ] ||
    fail "$preset: $(ffprobe -v error -show_streams "$preset.$movie" | grep aspect)"
  movie=mov
done
