#!/usr/bin/env bash
# Bodies near the hole: probe names their images, frames show them, and what is wrong with them is told with its place.
# shellcheck source=tests/cli/common.bash
source "$(dirname "$0")/common.bash"
cd "$folder"

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
assert abs(bodies[0]['one_plus_z'] - 1.2321) < 1e-3 and abs(bodies[0]['seen_v'] + 11.5) < 0.01, bodies
END
exits 0 "$DOMEFALL" probe beacon.yaml --at 0 --pixel 64.5,61.7
grep -q '^body  *beacon, at 10 M, 1 + z 1.2321, seen as V -11.50, image 0 ' stdout || fail "no body is named"
exits 0 "$DOMEFALL" probe beacon.yaml --at 0 --pixel 10,64 --json
python3 -c 'import json, sys; assert json.load(open("stdout"))["bodies"] == []'
exits 0 "$DOMEFALL" probe none.yaml --at 0 --pixel 64.5,61.7 --json
python3 -c 'import json, sys; assert "bodies" not in json.load(open("stdout"))'

# A frame has its images, and one without bodies has none.
exits 0 "$DOMEFALL" render beacon.yaml --frames 0 --out with --explain
grep -qE '^stars .* [3-9] images' stderr || fail "the frame has no images of the beacon"
exits 0 "$DOMEFALL" render none.yaml --frames 0 --out without --explain
grep -qE '^stars .* 0 images' stderr || fail "a frame without bodies has images"

show 'bodies: {beacon: {r: 2.5}}' >bad.yaml
exits 2 "$DOMEFALL" check bad.yaml
says 'bad.yaml:5:22: bodies.beacon.r must exceed 3 \(units of M\), got 2.5'
