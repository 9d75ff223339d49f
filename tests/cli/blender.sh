#!/usr/bin/env bash
# docs/blender_show.py in Blender itself, without a window.
source "$(dirname "$0")/common.bash"
command -v blender >/dev/null || exit 77
in_blender() {
  timeout 300 blender -b --python-exit-code 3 --python "$DOMEFALL_SOURCE/docs/blender_show.py" -- "$@" >stdout 2>&1 ||
    { cat stdout; fail "blender $*"; }
}

cat >show.yaml <<'END'
frames_per_second: 20
size: 128
black_hole: {mass_solar: 4.3e6}
disc: {inclination_deg: 60, opacity: 0.8}
bodies: {beacon: {r: 9, magnitude: -3}}
titles: [{text: "Title", height_deg: 8, shadow: 0.8, brightness: 3}]
output: {graded: none, layers: [sky, stars, disc, bodies, glare, titles]}
timeline: [{duration_s: 0.15, trajectory: {type: circular, r: 15, orbits: 0.01}}]
END
exits 0 "$DOMEFALL" render show.yaml --out made
"$DOMEFALL" states show.yaml --format json >states.json

# The layers, added by Blender's compositor, are the picture, to the rounding of half floats.
in_blender --states states.json --frames 'made/linear/show_#####.exr' --out 'added/#####.exr'
for frame in 00000 00001 00002; do
  file=made/linear/show_$frame.exr
  oiiotool "$file" --ch R,G,B added/$frame.exr --ch R,G,B --sub --abs "$file" --ch R,G,B --addc 0.001 --div -o off.exr
  off=$(oiiotool --stats off.exr | awk '/Stats Max/ { for (k = 3; k <= 5; ++k) if ($k > most) most = $k; print most }')
  awk -v off="$off" 'BEGIN { exit !(off < 0.003) }' || fail "frame $frame: the layers are off by $off"
done

# A sky whose colours are its own coordinates becomes the lens map that it was seen through.
sed -i '/^output/d; /^titles/d' show.yaml
echo 'output: {graded: none}' >>show.yaml
exits 0 "$DOMEFALL" render show.yaml --out plain --frames 1
exits 0 "$DOMEFALL" render show.yaml --out plain --frames 1 --lens-map
"$DOMEFALL" states show.yaml --format json --frames 1 >states.json
oiiotool --pattern fill:topleft=0,1,0:topright=1,1,0:bottomleft=0,0,0:bottomright=1,0,0 1024x512 3 -d float -o sky.exr
in_blender --states states.json --frames 'plain/linear/show_#####.exr' --lens 'plain/lens/show_#####.exr' --sky sky.exr \
  --out 'lensed/#####.exr'
# Within a pixel of that sky, but for the seam and for where the lens makes the sky small.
oiiotool lensed/00001.exr --ch R,G plain/lens/show_00001.exr --ch st.s,st.t --sub --abs --subc 0.005 --mulc 1e6 \
  --clamp:min=0:max=1 -o far.exr
far=$(oiiotool --stats far.exr | awk '/Stats Avg/ { most = $3 > $4 ? $3 : $4; print most }')
awk -v far="$far" 'BEGIN { exit !(far < 0.1) }' || fail "$far of the pixels are off"

# Its camera looks where the show's does: a lamp where the hole is falls into the middle of a flat picture.
sed -i 's/^size: .*/size: [64, 36]\ncamera: {projection: rectilinear, fov_deg: 70, look_at: hole}/' show.yaml
sed -i 's/type: circular.*orbits: 0.01/type: static, r: 15/' show.yaml
exits 0 "$DOMEFALL" render show.yaml --out flat --frames 0
"$DOMEFALL" states show.yaml --format json --frames 0 >states.json
cat >look.py <<'END'
import math, sys
import bpy
sys.argv = ["blender", "--", "--states", "states.json", "--frames", "flat/linear/show_#####.exr"]
exec(open("blender_show.py").read())
scene = bpy.context.scene
scene.frame_set(0)
ahead = scene.camera.matrix_world.to_3x3() @ __import__("mathutils").Vector((0, 0, -1))
assert (ahead - __import__("mathutils").Vector((0, 1, 0))).length < 1e-6, ahead
assert abs(math.degrees(scene.camera.data.angle_x) - 70) < 1e-4
assert (scene.render.resolution_x, scene.render.resolution_y) == (64, 36)
END
cp "$DOMEFALL_SOURCE/docs/blender_show.py" .
timeout 300 blender -b --python-exit-code 3 --python look.py >stdout 2>&1 || { cat stdout; fail "the camera looks elsewhere"; }
