#!/usr/bin/env bash
# Bodies near the hole: probe names their images, frames show them, and what is wrong with them is told with its place.
source "$(dirname "$0")/common.bash"

show() {
  cat <<END
size: 128
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {background: black, stars: none}}
camera: {look_at: hole, elevation_deg: 90}
$1
timeline: [{duration_s: 1, trajectory: {type: static, r: 30}}]
END
}
show 'bodies: {beacon: {r: 10, inclination_deg: 90, azimuth_deg: 90, magnitude: -9}}' >beacon.yaml
show '' >none.yaml

# The beacon circles over the observer and the hole, and is seen against the hole and beside it.
exits 0 "$DOMEFALL" probe beacon.yaml --at 0 --pixel 64.5,61.7 --json
python3 - "$folder/stdout" <<'END'
import json, sys
bodies = json.load(open(sys.argv[1]))['bodies']
assert bodies[0]['name'] == 'beacon' and bodies[0]['order'] == 0 and bodies[0]['r'] == 10, bodies
assert abs(bodies[0]['one_plus_z'] - 1.2321) < 1e-3 and abs(bodies[0]['seen_v'] + 11.30) < 0.01, bodies
END
exits 0 "$DOMEFALL" probe beacon.yaml --at 0 --pixel 64.5,61.7
grep -q '^body  *beacon, at 10 M, 1 + z 1.2321, seen as V -11.30, image 0 ' stdout || fail "no body is named"
# So it is before the silhouette, where no sky is seen.
show 'bodies: {beacon: {trajectory: {type: static, r: 10}, magnitude: -9}}' | sed 's/4.3e6/&, spin: 0.5/' >before.yaml
exits 0 "$DOMEFALL" probe before.yaml --at 0 --pixel 66,64.5
grep -q '^sees  *no light of any sky' stdout || fail "a sky is seen through the hole"
grep -q '^body  *beacon, at 10 M' stdout || fail "a body before the silhouette is not named"
exits 0 "$DOMEFALL" probe before.yaml --at 0 --pixel 66,64.5 --json
python3 -c 'import json, sys; assert json.load(open("stdout"))["direction"] is None'
exits 0 "$DOMEFALL" probe beacon.yaml --at 0 --pixel 10,64 --json
python3 -c 'import json, sys; assert json.load(open("stdout"))["bodies"] == []'
exits 0 "$DOMEFALL" probe none.yaml --at 0 --pixel 64.5,61.7 --json
python3 -c 'import json, sys; assert "bodies" not in json.load(open("stdout"))'

# A frame has its images, and one without bodies has none.
exits 0 "$DOMEFALL" render beacon.yaml --frames 0 --out with --explain
grep -qE '^stars .* [3-9] images' stderr || fail "the frame has no images of the beacon"
exits 0 "$DOMEFALL" render none.yaml --frames 0 --out without --explain
grep -qE '^stars .* 0 images' stderr || fail "a frame without bodies has images"

# The V that a body is seen as is that of its pixels: a star of this V and of the shifted temperature has
# as much light in a frame without a hole.
ratio=1.2321
temperature=$(python3 -c '
b_v = 0.6  # by Ballesteros (2012)
star = 4600 * (1 / (0.92 * b_v + 1.7) + 1 / (0.92 * b_v + 0.62))
print(star * '$ratio')')
show "bodies: {beacon: {r: 10, inclination_deg: 90, azimuth_deg: 90, magnitude: 0, temperature_k: $temperature}}
output: {linear: float, graded: none}" >warm.yaml
exits 0 "$DOMEFALL" probe warm.yaml --at 0 --pixel 64.5,61.7 --json
v=$(python3 -c 'import json; print(json.load(open("stdout"))["bodies"][0]["seen_v"])')
printf 'ra_deg,dec_deg,v_mag,b_v\n0,0,%s,0.6\n' "$v" >known.csv
cat >known.yaml <<'END'
size: 128
sky: {region_I: {background: black, stars: {catalogue: known.csv, gain: 1}}}
camera: {look_at: {ra_deg: 0, dec_deg: 0}, elevation_deg: 90}
output: {linear: float, graded: none}
timeline: [{duration_s: 1, trajectory: {type: static}}]
END
luminance() { # of the middle of frame 0, in ACEScg
  exits 0 "$DOMEFALL" render "$1.yaml" --frames 0 --out "$1"
  oiiotool "$1/linear/$1_00000.exr" --cut 40x40+44+44 -o "$1.exr"
  oiiotool --stats "$1.exr" | awk '/Stats Avg/ {
    print 0.2722287 * $3 + 0.6740818 * $4 + 0.0536895 * $5 }'
}
python3 - "$(luminance warm)" "$(luminance known)" <<'END'
import math, sys
off = 2.5 * math.log10(float(sys.argv[1]) / float(sys.argv[2]))
assert abs(off) < 0.02, f'the pixels are {off} magnitudes brighter than the V that is told'
END

# A body that reaches the hole, by the radius that it is given or by that of its light, is no black frame.
refused() { # refused KEYS PATTERN
  show "bodies: {sun: {$1}}" >sun.yaml
  exits 2 "$DOMEFALL" check sun.yaml
  says "sun.yaml:5:[0-9]*: bodies.sun$2"
}
refused 'r: 10, radius: 1e6' '.radius must stay below 8 \(units of M\), got 1e6: it moves at r = 10 M'
refused 'r: 10, radius: 8' '.radius must stay below 8 '
refused 'r: 10, magnitude: -43' '.magnitude asks for a sphere of the radius [0-9.e+]* at 6000 K, which must stay below 8 '
refused 'r: 3.01, magnitude: -29, temperature_k: 3000' '.magnitude asks for a sphere'
refused 'r: 10, temperature_k: 100' ' asks for a sphere .* higher temperature_k'
refused 'r: 10, absolute_magnitude: -60' '.absolute_magnitude asks for a sphere'
refused 'trajectory: {type: infall, rest_r: 12}, radius: 10' '.radius must stay below 10 '
refused 'trajectory: {type: bound, periastron: 8, apoastron: 40}, radius: 7' '.radius must stay below 6 '
refused 'r: 30, radius: 0.1, magnitude: -100, temperature_k: 100' '.magnitude asks for .* W/m'
# One in which the observer is, or which is next to him, is told of.
show 'bodies: {sun: {r: 40, radius: 20}}' >near.yaml
exits 0 "$DOMEFALL" check near.yaml
tells 'frame 0, segment 1: bodies.sun is not drawn, to frame 29: the observer is within its radius of 20 M'
# So is one that he passes within a third of a second of a long show.
cat >long.yaml <<'END'
size: 16
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {background: grid, stars: none}}
output: {linear: none, graded: png8}
bodies: {b: {trajectory: {type: static, r: 15}, radius: 2, magnitude: -6}}
timeline:
  - {duration_s: 339.97, trajectory: {type: static, r: 20}}
  - {duration_s: 0.3, trajectory: {type: infall, from_r: 20, to_r: 11}}
  - {duration_s: 339.97, trajectory: {type: static, r: 11}}
END
exits 0 "$DOMEFALL" check long.yaml
grep -q 'bodies.b is not drawn' stdout || fail "check does not tell of a body that is passed quickly"
exits 0 "$DOMEFALL" check beacon.yaml
! grep -q 'is not drawn' stdout || fail "check tells of a body that is drawn"
