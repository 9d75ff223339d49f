#!/usr/bin/env bash
# Pictures in every projection: against ffmpeg's v360 of a dome's, and what `probe` says of a
# direction in each of them.
source "$(dirname "$0")/common.bash"
command -v ffmpeg >/dev/null || exit 77

# write_picture FILE SIZE CAMERA WIDTH: soft stars around the hole.
write_picture() {
  cat >"$1" <<END
title: Around
size: $2
black_hole: {mass_solar: 4.3e6}
camera: {look_at: hole, $3}
sky: {region_I: {background: black, stars: {catalogue: standard, max_magnitude: 3}}}
stars: {law: size, min_sigma_deg: $4, max_sigma_deg: $4, growth: 0.1}
exposure: {ev: 4}
output: {linear: none, graded: png16}
timeline: [{duration_s: 1, trajectory: {type: static, r: 15}}]
END
}
zenith='elevation_deg: 20, dome_tilt_deg: 10, roll_deg: 30'
write_picture dome.yaml 512 "$zenith, projection: domemaster" 2.5
write_picture sphere.yaml 512 "$zenith, projection: equirectangular" 2.5
write_picture cube.yaml 128 "$zenith, projection: cubemap" 2.5
write_picture wide.yaml 512 "$zenith, projection: fisheye, fov_deg: 240" 2.5
write_picture cut.yaml '[512, 400]' "$zenith, projection: fisheye, fov_deg: 240, cut: back" 2.5
write_picture flat.yaml '[160, 120]' 'roll_deg: 30, projection: rectilinear, fov_deg: 80' 5.625
write_picture round.yaml '[160, 120]' 'roll_deg: 30, projection: stereographic, fov_deg: 80' 5.625
pictures=(dome sphere cube wide cut flat round)
for name in "${pictures[@]}"; do
  exits 0 "$DOMEFALL" render "$name.yaml" --frames 0 --out "$name"
done
picture() { echo "$1/graded/$1_00000.png"; }

# alike A FILTER B FILTER: ffmpeg finds so little between both that it is interpolation.
alike() {
  ffmpeg -hide_banner -nostats -i "$(picture "$1")" -i "$(picture "$3")" \
    -lavfi "[0]format=gbrp16,$2[a];[1]format=gbrp16,$4[b];[a][b]psnr" -f null - 2>psnr ||
    { cat psnr >&2; fail "ffmpeg does not compare $1 and $3"; }
  psnr=$(grep -oE 'average:(inf|[0-9.]+)' psnr | cut -d: -f2)
  echo "$1 and $3: $psnr dB"
  awk -v p="$psnr" 'BEGIN { exit !(p == "inf" || p > 40) }' || fail "$1 and $3: $psnr dB"
}
# The front is at the bottom of a dome, 90 degrees below its middle. v360 takes a sphere that it reads
# half a pixel aside, so that here it only writes some.
to_sphere='w=512:h=256:interp=cubic'
alike dome "v360=fisheye:e:ih_fov=180:iv_fov=180:pitch=-90:$to_sphere,crop=512:120:0:0" \
  sphere 'crop=512:120:0:0'
alike wide "v360=fisheye:e:ih_fov=240:iv_fov=240:pitch=-90:$to_sphere,crop=512:160:0:0" \
  sphere 'crop=512:160:0:0'
alike cube "v360=c3x2:e:$to_sphere" sphere null
alike wide crop=512:400:0:112 cut null
# The hole stands 30 degrees above the front of the sphere.
alike cube 'v360=c3x2:flat:h_fov=80:v_fov=64.37:pitch=30:w=160:h=120:interp=cubic' flat null
alike cube 'v360=c3x2:sg:h_fov=80:v_fov=61.18:pitch=30:w=160:h=120:interp=cubic' round null

# One direction in all of them, by formulas of the projections that share nothing with ours.
python3 - "$DOMEFALL" <<'END'
import math, subprocess, sys
azimuth, elevation = math.radians(25), math.radians(40)  # of the audience, in the picture's axes
x = math.cos(elevation) * math.sin(azimuth)
y = math.cos(elevation) * math.cos(azimuth)
z = math.sin(elevation)


def fisheye(degrees, width, above):
    r = (math.pi / 2 - elevation) / math.radians(degrees) * width
    return width / 2 + r * math.sin(azimuth), width / 2 + r * math.cos(azimuth) - above


def flat(name):  # its middle looks 30 degrees up
    c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
    along, up = y * c + z * s, z * c - y * s
    if name == 'rectilinear':
        k = 80 / math.tan(math.radians(40)) / along
    else:
        k = 80 / math.tan(math.radians(20)) / (1 + along)
    return 80 + k * x, 60 - k * up


places = {
    'dome': fisheye(180, 512, 0),
    'wide': fisheye(240, 512, 0),
    'cut': fisheye(240, 512, 112),
    'sphere': (256 + azimuth / math.tau * 512, 128 - elevation / math.tau * 512),
    'cube': (192 + 64 * x / y, 192 - 64 * z / y),  # on the front face
    'flat': flat('rectilinear'),
    'round': flat('stereographic'),
}
said = {}
for name, (across, down) in places.items():
    command = [sys.argv[1], 'probe', name + '.yaml', '--frame', '0', '--pixel',
               f'{across + 0.5:.12f},{down + 0.5:.12f}']
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    # Stars are named by their pixels, of which each picture has others.
    said[name] = [line for line in text.splitlines() if not line.startswith('star ')]
assert all(text == said['dome'] for text in said.values()), said
assert any('sky I' in line for line in said['dome']), said
END

# A change of the projection is another frame, which `render` makes again.
exits 0 "$DOMEFALL" render wide.yaml --frames 0 --out wide
says '^0 frames made, 1 already there'
sed -i 's/fov_deg: 240/fov_deg: 230/' wide.yaml
exits 0 "$DOMEFALL" render wide.yaml --frames 0 --out wide
says '^1 frames made, 0 already there'

# What a cubemap cannot show is refused.
exits 2 "$DOMEFALL" render cube.yaml --frames 0 --out none --overlay rim
says '^--overlay rim: only burn-in can be drawn on a cubemap'
exits 0 "$DOMEFALL" render cube.yaml --frames 0 --out cube_numbers --overlay burn_in
exits 0 "$DOMEFALL" render sphere.yaml --frames 0 --out sphere_marks \
  --overlay grid,rim,safe_area,sweet_spot,silhouette,einstein_ring,star_names,burn_in
