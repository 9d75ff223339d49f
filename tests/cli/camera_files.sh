#!/usr/bin/env bash
# The camera of a show in the formats of other programs, and back again.
source "$(dirname "$0")/common.bash"

# moves PROJECTION CAMERA: a show with one camera in its keyframes and segments.
moves() {
  cat <<END
title: "A \"camera\" # that turns"
frames_per_second: 24000/1001
size: $1
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {background: grid, stars: none}}
camera: {$2}
END
}
path='timeline:
  - {duration_s: 2, trajectory: {type: circular, r: 5, orbits: 1}}
  - {duration_s: 1, trajectory: {type: infall, from_r: 5, to_r: 1}}'
turns='keyframes:
  - {at_s: 0.3, camera: {look_at: Vega, roll_deg: 20}}
  - {at_s: 1.7, camera: {look_at: outward, roll_deg: 400}, ease: eased}
  - {at_s: 2.5, camera: {euler_deg: [20, 130, 70]}, ease: linear}'

# off_by ONE OTHER: by how many radians the cameras of two shows differ at most, over all frames.
off_by() {
  "$DOMEFALL" states "$1" --format json >one.json
  "$DOMEFALL" states "$2" --json >other.json
  python3 - <<'END'
import json, math
off = 0
one, other = json.load(open("one.json")), json.load(open("other.json"))
assert len(one) == len(other) > 60
for a, b in zip(one, other):
    for name in ("world_from_camera", "world_from_audience"):
        difference = math.sqrt(sum((x - y) ** 2 for row, again in zip(a[name], b[name]) for x, y in zip(row, again)))
        off = max(off, difference / math.sqrt(2))
print(off)
END
}

k=0
while IFS='|' read -r size camera; do
  k=$((k + 1))
  { moves "$size" "${camera:+$camera, }look_at: hole"; echo "$turns"; echo "$path"; } >turning.yaml
  for format in chan usda; do
    exits 0 "$DOMEFALL" states turning.yaml --format $format
    cp stdout "camera.$format"
    { moves "$size" "${camera:+$camera, }file: camera.$format"; echo "$path"; } >back.yaml
    off=$(off_by turning.yaml back.yaml)
    awk -v off="$off" 'BEGIN { exit !(off < 1e-6) }' || fail "$size $camera $format: a round trip is off by $off"
  done
done <<'END'
64|
64|dome_tilt_deg: 20
[64, 36]|projection: rectilinear
[64, 36]|projection: stereographic, fov_deg: 120
64|projection: equirectangular
END
[ "$k" = 5 ] || fail "$k cameras"

# The audience's axes do not lean with the dome: the camera's attitude against them is the tilt.
{ moves 64 'dome_tilt_deg: 20'; echo "$path"; } >leaning.yaml
exits 0 "$DOMEFALL" states leaning.yaml --format usda --frames 5
python3 - stdout <<'END'
import math, re, sys
text = open(sys.argv[1]).read()
assert text.startswith("#usda 1.0\n") and 'doc = "A \\"camera\\" # that turns"' in text, text[:200]
matrices = re.findall(r"5: \( (\(.*\)) \)", text)
assert len(matrices) == 2, matrices
rows = [[float(x) for x in row.split(",")] for row in re.findall(r"\(([^()]*)\)", matrices[1])]
# The zenith is ahead of the camera, and leans to the back.
ahead = [-x for x in rows[2][:3]]
assert abs(ahead[1] - math.cos(math.radians(20))) < 1e-12 and abs(abs(ahead[2]) - math.sin(math.radians(20))) < 1e-12, ahead
END

# Scene-linear files have the matrix by the names that other programs know: a point ahead is in the
# middle of the picture, and one to the right at its right edge.
{ moves '[64, 36]' 'projection: rectilinear, fov_deg: 90, look_at: hole'; echo "timeline: [{duration_s: 1, trajectory: {type: static, r: 9}}]"; } >flat.yaml
exits 0 "$DOMEFALL" render flat.yaml --frames 0 --out flat
exits 0 oiiotool --info -v flat/linear/flat_00000.exr
python3 - stdout <<'END'
import re, sys
text = open(sys.argv[1]).read()
def matrix(name):
    return [float(x) for x in re.search(name + r": ([-0-9., e]+)", text)[1].split(",")]
camera, ndc = matrix("worldToCamera"), matrix("worldToNDC")
def times(point, m):
    return [sum(p * m[4 * k + c] for k, p in enumerate(point + [1])) for c in range(4)]
assert times([0, 0, -1], camera)[:3] == [0, 0, 1], camera
x, y, z, w = times([0, 0, -2], ndc)
assert (x / w, y / w) == (0.5, 0.5), (x, y, z, w)
x, y, z, w = times([1, 0, -1], ndc)
assert abs(x / w - 1) < 1e-6 and abs(y / w - 0.5) < 1e-6, (x, y, z, w)
x, y, z, w = times([0, 36 / 64, -1], ndc)
assert abs(y / w) < 1e-6, (x, y, z, w)
END

# What cannot be read is told with its place, and another format is none.
printf '0 0 0 0 1 2\n' >short.chan
printf 'camera: {file: short.chan}\ntimeline: [{duration_s: 1}]\n' >short.yaml
exits 2 "$DOMEFALL" check short.yaml
says 'short.yaml:1:16: camera.file .*short.chan:1: a camera has a frame'
exits 2 "$DOMEFALL" states flat.yaml --format fbx
says 'fbx'
