#!/usr/bin/env bash
# Pictures of a disc and of a body's surface that cannot be used are told with the place of their key
# in the show before anything is made.
source "$(dirname "$0")/common.bash"

# refused CODE PATTERN: checking the show ends with that code and says why
refused() {
  exits "$1" "$DOMEFALL" check show.yaml
  says "$2"
}
shown() { printf 'black_hole: {mass_solar: 4.3e6}\ntimeline: [{duration_s: 1, trajectory: {type: static, r: 20}}]\n%s\n' "$1" >show.yaml; }
as_disc() { shown "disc: {pattern: {file: $1}}"; }
as_texture() { shown "bodies: {a: {r: 10, radius: 1, magnitude: -10, temperature_k: 5000, texture: $1}}"; }
disc='^show.yaml:3:24: disc.pattern.file ' texture='^show.yaml:3:[0-9]+: bodies.a.texture '

oiiotool --pattern noise 256x128 3 -o whole.png
oiiotool --pattern noise 256x128 3 -o whole.exr
oiiotool --pattern noise 100x100 3 -o square.png
for kind in png exr; do
  head -c $(($(stat -c %s "whole.$kind") / 2)) "whole.$kind" >"short.$kind"
done
cp whole.png damaged.png
printf 'damaged' | dd of=damaged.png bs=1 seek=$(($(stat -c %s whole.png) / 2)) conv=notrunc status=none
printf 'This is no picture.' >text.png

for file in short.png short.exr damaged.png text.png; do
  as_disc "$file"
  refused 2 "${disc}cannot be used: $file: the image cannot be read"
done
as_texture damaged.png
refused 2 "${texture}cannot be used: damaged.png: the image cannot be read"
exits 2 "$DOMEFALL" render show.yaml --size 64 --frames 0 --out out
says "${texture}cannot be used: damaged.png: the image cannot be read"
[ ! -e out ] || fail "a folder was made"
as_texture square.png
refused 2 "${texture}cannot be used: square.png: a panorama is twice as wide as high, .* this one is 100 x 100$"
as_disc none.png
refused 75 "${disc}names the file 'none.png', which is neither"
as_texture none.png
refused 75 "${texture}names the file 'none.png', which is neither"

# A pattern may have any shape.
as_disc square.png
exits 0 "$DOMEFALL" states show.yaml
as_texture whole.png
exits 0 "$DOMEFALL" states show.yaml
