#!/usr/bin/env bash
# Sky maps as a user makes them: a starless Milky Way from the shipped catalogue, imports of pictures,
# what their checks say, files that are damaged, and a show with a .sky file behind it.
source "$(dirname "$0")/common.bash"
stars=$DOMEFALL_SOURCE/shows/assets/stars_to_8.csv
panorama=$DOMEFALL_SOURCE/shows/assets/milky_way.exr
# Where any picture will do, the same at a quarter of the size takes a tenth of the time.
oiiotool "$panorama" --resize:filter=box 1024x512 -o small.exr

# A sky of stars: all their light is in it, and it lies as it should.
exits 0 "$DOMEFALL" sky build --stars "$stars" --fainter-than 6.5 --blur 2 --size 64 --out starlight.sky
says '^32537 stars, 1\.48293e-06 W/m\^2 of light; the map has 1\.4829[0-9]e-06 W/m\^2'
exits 0 "$DOMEFALL" sky info starlight.sky --verify
grep -q '^kind  *thermal' stdout || fail "the map of starlight is not thermal"
grep -q '^stars: fainter than V = 6.5$' stdout || fail "the file does not say which stars it has"
grep -q '^made by: .*32537 stars' stdout || fail "the file does not say what it is made of"
exits 0 "$DOMEFALL" sky check starlight.sky
grep -q 'lies on the sky as stated, by its Milky Way' stdout || fail "$(tail -1 stdout)"
exits 2 "$DOMEFALL" sky build --stars "$stars" --fainter-than 8.5 --out none.sky
says 'no star is fainter'
exits 2 "$DOMEFALL" sky build --stars "$stars" --blur 0.5 --size 64 --out coarse.sky
says 'too coarse for a blur'
if [ -e none.sky ] || [ -e coarse.sky ]; then fail "a failed build left a file"; fi

# A picture as it lies, and mirrored by mistake.
exits 0 "$DOMEFALL" sky import "$panorama" --size 128 --licence 'free with credit' --out as_it_is.sky
says '^as_it_is.sky: equatorial, RA 0 deg in the middle, growing to the left, north up$'
says '^it lies on the sky as stated'
exits 0 "$DOMEFALL" sky import small.exr --size 128 --ra-right --out mirrored.sky
says '^warning: .*fits better as equatorial, RA 0 deg in the middle, growing to the left, north up$'
exits 2 "$DOMEFALL" sky check mirrored.sky
says 'fits better as equatorial, RA 0 deg in the middle, growing to the left, north up'
exits 0 "$DOMEFALL" sky info as_it_is.sky
grep -q '^licence: free with credit$' stdout || fail "the licence is not in the file"
exits 0 "$DOMEFALL" sky check small.exr

# What cannot be read is told by name, and where.
exits 2 "$DOMEFALL" sky import nowhere.png --out x.sky
says '^nowhere.png: '
# What the first bytes say is there is not.
for start in 'II*\0\10\0\0\0' '\x89PNG\r\n\x1a\n' 'v/1\1\2\0\0\0' '#?RADIANCE' '\xff\xd8\xff'; do
  printf '%b' "$start" >short.tif
  exits 2 "$DOMEFALL" sky import short.tif --out x.sky
  says '^short.tif: '
done
head -c 100000 as_it_is.sky >short.sky
cp as_it_is.sky damaged.sky
printf 'x' | dd of=damaged.sky bs=1 seek=200000 conv=notrunc status=none
exits 0 "$DOMEFALL" sky info damaged.sky
exits 2 "$DOMEFALL" sky info damaged.sky --verify
says '^damaged.sky: byte [0-9]+: face 1 of the level of size 128 is damaged'

# A show finds its sky; the picture is that of the panorama, to what 128 texels lose.
show() {
  cat >"$1.yaml" <<END
title: $1
size: 64
frames_per_second: 1
sky: {region_I: {background: $2, stars: none}}
timeline: [{duration_s: 1, trajectory: {type: static}, camera: {look_at: {ra_deg: 266, dec_deg: -29}}}]
END
}
show mapped ./as_it_is.sky
show pictured "$panorama"
show thermal ./starlight.sky
for name in mapped pictured thermal; do
  exits 0 "$DOMEFALL" render "$name.yaml" --frames 0 --out "$name"
done
# Stars that are drawn though a map has their light are told.
sed 's/stars: none/stars: standard/' thermal.yaml >twice.yaml
exits 0 "$DOMEFALL" check twice.yaml
grep -q 'stars_to_9.stars from V = 6.5 to 9 are seen twice: .* give max_magnitude: 6.5' stdout || fail "$(cat stdout)"
tells '^sky +starlight.sky, .* fainter than V = 6.5; stars_to_9.stars, 131,085 stars to V = 9$'
sed 's/stars: none/stars: naked_eye/' thermal.yaml >once.yaml
exits 0 "$DOMEFALL" check once.yaml
grep -q '^no warnings' stdout || fail "$(cat stdout)"
show broken ./short.sky
exits 2 "$DOMEFALL" render broken.yaml --frames 0 --out broken
says 'short.sky: byte 100000'
mapped=$(find mapped -name '*.exr') pictured=$(find pictured -name '*.exr')
oiiotool --fail 0.003 --hardfail 0.01 "$mapped" "$pictured" --diff >compared 2>&1 ||
  fail "the mapped sky is not the panorama: $(cat compared)"
# Frames are known by what the .sky file holds.
exits 0 "$DOMEFALL" render mapped.yaml --frames 0 --out mapped
says '0 frames made'
cp mirrored.sky as_it_is.sky
exits 0 "$DOMEFALL" render mapped.yaml --frames 0 --out mapped
says '1 frames? made'

# A number that is none is refused, not used.
for option in "--centre-ra nan" "--unit nan" "--unit inf"; do
  # shellcheck disable=SC2086  # two words
  exits 2 "$DOMEFALL" sky import "$panorama" --out nan.sky $option
  if [ -e nan.sky ]; then fail "a map was made of $option"; fi
done

# What a picture says of itself is obeyed and told.  A frame of the whole sky is scene-linear ACEScg,
# and comes back as itself.
cat >saturated.yaml <<'END'
size: 128
output: {linear: float, graded: none}
camera: {projection: equirectangular}
sky: {region_I: {background: ./red.exr, stars: none, black_cd_m2: none}}
timeline: [{duration_s: 0.1}]
END
oiiotool --create 128x64 3 --fill:color=1,0,0 128x64 -o red.exr
exits 0 "$DOMEFALL" render saturated.yaml --frames 0 --out saturated
cp "$(find saturated -name '*.exr')" frame.exr
sed 's/red.exr/frame.exr/' saturated.yaml >again.yaml
exits 0 "$DOMEFALL" render again.yaml --frames 0 --out again
oiiotool --fail 0.0005 "$(find again -name '*.exr')" frame.exr --diff >compared 2>&1 ||
  fail "a frame is not itself as a sky: $(cat compared)"
exits 0 "$DOMEFALL" check again.yaml
tells '^ *frame.exr is taken as: 128 x 64, linear \(floats\), primaries ACEScg \(chromaticities\)$'
exits 0 "$DOMEFALL" check again.yaml --json
tells '"map_taken_as":"128 x 64, linear \(floats\), primaries ACEScg \(chromaticities\)"'

# A cropped layer of a renderer: the display window is the sky.
oiiotool --create 32x16+16+8 3 --fill:color=1,1,1 32x16 --fullsize 64x32+0+0 --chnames Combined.R,Combined.G,Combined.B \
  --create 32x16+16+8 3 --fullsize 64x32+0+0 --chnames AO.R,AO.G,AO.B --chappend -o layers.exr
exits 0 "$DOMEFALL" sky info layers.exr
grep -q '^taken as  *layer Combined, 64 x 32, data window 32 x 16 at 16, 8, linear' stdout || fail "$(cat stdout)"
exits 0 "$DOMEFALL" sky import layers.exr --out layers.sky
says '^layers.exr is taken as: layer Combined, 64 x 32, data window 32 x 16 at 16, 8, linear'
exits 0 "$DOMEFALL" sky info layers.sky
grep -q '^taken as: layer Combined, 64 x 32' stdout || fail "the file does not say what it was: $(cat stdout)"
oiiotool layers.exr --chnames Normal.X,Normal.Y,Normal.Z,A.X,A.Y,A.Z -o normals.exr
sed 's/red.exr/normals.exr/' saturated.yaml >normals.yaml
exits 2 "$DOMEFALL" check normals.yaml
says 'none of its channels are colours: .*Normal.X, Normal.Y, Normal.Z'
