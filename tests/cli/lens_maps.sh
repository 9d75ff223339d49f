#!/usr/bin/env bash
# render --lens-map: the numbers of `probe`, a picture that oiiotool lenses by them as we do, and files
# that are whole, resumed and protected as frames are.
source "$(dirname "$0")/common.bash"

# A picture of the whole sky without a seam, grey, so that no primaries are in the way.
python3 - <<'END'
import math
width, height = 512, 256
with open('picture.ppm', 'wb') as f:
    f.write(b'P6 %d %d 65535\n' % (width, height))
    for y in range(height):
        latitude = math.pi * (0.5 - (y + 0.5) / height)
        for x in range(width):
            a = math.tau * (x + 0.5) / width
            wave = math.cos(latitude) ** 2 * (math.sin(2 * a) + math.cos(3 * a + 1)) / 4
            value = 0.5 + wave + 0.2 * math.sin(latitude)
            f.write(round(40000 * value).to_bytes(2, 'big') * 3)
END
oiiotool picture.ppm -d float -o picture.exr

# write_lensed FILE: the picture around an observer who falls past and into the hole.
write_lensed() {
  cat >"$1" <<END
title: Lensed
frames_per_second: 2
size: 128
black_hole: {mass_solar: 4.3e6}
sky:
  blueshift_power: 0
  region_I: {background: picture.exr, black_cd_m2: none, stars: none}
  region_III: {background: black, stars: none}
effects: {intensity: false}
output: {linear: float, graded: none}
timeline: [{duration_s: 3, trajectory: {type: infall, from_r: 4, to_r: 0.05}, camera: {look_at: hole}}]
END
}
write_lensed fall.yaml
exits 0 "$DOMEFALL" render fall.yaml --lens-map --threads 1 --out one
says '^6 lens maps made, 0 already there'
[ "$(find one -type f | sort | paste -sd' ')" = "$(echo one/lens/fall_0000{0..5}.exr)" ] ||
  fail "other files: $(find one)"

# Whole, resumed, protected.
exits 0 "$DOMEFALL" render fall.yaml --lens-map --threads 4 --out four
same_frames one four
truncate -s -1 four/lens/fall_00002.exr
exits 0 "$DOMEFALL" render fall.yaml --lens-map --out four --dry-run
[ "$(cat stdout)" = 2 ] || fail "not frame 2: $(cat stdout)"
exits 0 "$DOMEFALL" render fall.yaml --lens-map --out four
says '^1 lens maps made, 5 already there'
same_frames one four
exits 2 "$DOMEFALL" render fall.yaml --size 64 --lens-map --frames 1 --out four
says '^four/lens/fall_00001.exr: a good file, but another one than this run makes \(128 x 128 pixels\)'
same_frames one four
exits 0 "$DOMEFALL" render fall.yaml --size 64 --lens-map --frames 1 --out four --replace
sed -i 's/to_r: 0.05/to_r: 0.04/' fall.yaml
exits 0 "$DOMEFALL" render fall.yaml --lens-map --out one
says '^5 lens maps made, 1 already there'
write_lensed fall.yaml
exits 2 "$DOMEFALL" render fall.yaml --lens-map --overlay rim

exits 0 "$DOMEFALL" render fall.yaml --lens-map --out lensed
exits 0 "$DOMEFALL" render fall.yaml --out lensed

# What is looked at, as floats, and the picture lensed by another program: all by one oiiotool, which takes a
# fifth of a second to start.  (A TIFF keeps the order of the channels.)
channels=sky.x,sky.y,sky.z,st.s,st.t,sky.region,light.one_plus_z,light.amplification,light.order,edge.distance
about=sky.region,edge.distance,light.amplification,st.s
asked=()
for frame in 0 5; do
  map=lensed/lens/fall_0000$frame.exr
  asked+=("$map" --ch "$channels" -d float -o "map$frame.tif" "$map" --ch "$about" -d float -o "about$frame.tif"
    "lensed/linear/fall_0000$frame.exr" --ch R -d float -o "ours$frame.tif"
    picture.exr "$map" --ch "st.s,st.t" --st_warp:flip_t=1 --cut 128x128+0+0 --ch R -d float -o "warped$frame.tif")
done
oiiotool "${asked[@]}"
# numbers FILE: a line for each pixel.
numbers() { oiiotool --dumpdata "$1" | sed -n 's/^ *Pixel (\([0-9]*\), \([0-9]*\)):/\1 \2/p'; }
for frame in 0 5; do numbers "map$frame.tif" >"map$frame"; done
python3 - "$DOMEFALL" <<'END'
import json, math, random, subprocess, sys
random.seed(5)
regions = set()
for frame in (0, 5):
    with open(f'map{frame}') as f:
        pixels = [[float(word) for word in line.split()] for line in f]
    assert len(pixels) == 128 * 128
    assert all(all(v == 0 for v in p[2:]) == (math.hypot(p[0] - 63.5, p[1] - 63.5) > 64) for p in pixels)
    regions |= {p[7] for p in pixels}
    for p in random.sample(pixels, 12):
        x, y, *place, s, t, region, shift, amplified, order, edge = p
        command = [sys.argv[1], 'probe', 'fall.yaml', '--frame', str(frame), '--pixel', f'{x + 1:g},{y + 1:g}', '--json']
        fact = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
        assert fact['inside'] == (region != 0), (p, fact)
        if not fact['inside']:
            continue
        assert region == {'I': 1, 'III': 3, 'IV': 4}[fact['sky']], (p, fact)
        wanted = fact['direction'] + [(0.5 - fact['ra_deg'] / 360) % 1, (fact['dec_deg'] + 90) / 180]
        for key in ('one_plus_z', 'amplification', 'order'):
            wanted.append(fact[key] or 0)
        wanted.append(180 if fact['to_edge_deg'] is None else fact['to_edge_deg'])
        for a, b in zip([*place, s, t, shift, amplified, order, edge], wanted, strict=True):
            assert abs(a - b) <= 1.3e-7 * max(1, abs(b)), (a, b, p, fact)
assert regions == {0, 1, 3, 4}, regions
END

# Lensed by another program. Where the picture itself is bent within a few pixels, at the ring and the
# silhouette, the frame is a mean over the pixel, and the warp is not.
for frame in 0 5; do
  for what in warped ours about; do numbers $what$frame.tif >$what; done
  paste -d' ' warped ours about >pairs
  python3 - <<'END'
worst = total = count = 0
with open('pairs') as f:
    for line in f:
        words = [float(w) for w in line.split()]
        warped, ours, (region, edge, amplified, s) = words[2], words[5], words[8:]
        if region != 1 or edge < 15 or not 0.1 < amplified < 10 or not 0.01 < s < 0.99:
            continue
        worst = max(worst, abs(warped - ours))
        total += abs(warped - ours)
        count += 1
print(f'{count} pixels, worst {worst:.5f}, mean {total / max(count, 1):.6f}')
assert count > 1500 and worst < 0.003 and total / count < 0.0005, (count, worst, total)
END
done
