#!/usr/bin/env bash
# domefall preview: a flat still, the hole in its middle, whatever the show's own projection.
# shellcheck source=tests/cli/common.bash
source "$(dirname "$0")/common.bash"
cd "$folder"
write_show fall.yaml
exits 0 "$DOMEFALL" preview fall.yaml --frame 6 --out still.png --size 320x180
python3 - still.png <<'END'
import struct, sys, zlib
data = open(sys.argv[1], 'rb').read()
assert data[:8] == b'\x89PNG\r\n\x1a\n'
width, height, depth, colour = struct.unpack('>IIBB', data[16:26])
assert (width, height, depth, colour) == (320, 180, 16, 2), (width, height, depth, colour)
at, packed = 8, b''
while at < len(data):
    size, kind = struct.unpack('>I4s', data[at:at + 8])
    if kind == b'IDAT':
        packed += data[at + 8:at + 8 + size]
    at += 12 + size
raw, stride, rows, above = zlib.decompress(packed), width * 6, [], bytes(width * 6)
for y in range(height):
    kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
    for x in range(stride):
        a = line[x - 6] if x >= 6 else 0
        b, c = above[x], above[x - 6] if x >= 6 else 0
        p = a + b - c
        paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
        line[x] = (line[x] + (0, a, b, (a + b) // 2, paeth)[kind]) & 255
    rows.append(line)
    above = bytes(line)
def light(x, y):
    return sum(struct.unpack('>3H', rows[y][6 * x:6 * x + 6]))
assert light(160, 90) == 0, 'the hole is in the middle'
assert sum(light(x, y) > 0 for x in (5, 315) for y in range(0, 180, 5)) > 60, 'sky at the sides'
END
# --at takes a time, a marker or the end of the show, and gives the frame nearest to it.
printf 'markers: {there: 0:00.5}\n' >>fall.yaml
exits 0 "$DOMEFALL" preview fall.yaml --frame 6 --out frame.png --size 64x36
for at in 0.5 0:00.52 there; do
  exits 0 "$DOMEFALL" preview fall.yaml --at "$at" --out at.png --size 64x36
  cmp -s frame.png at.png || fail "--at $at is not frame 6"
done
exits 0 "$DOMEFALL" preview fall.yaml --frame 23 --out frame.png --size 64x36
exits 0 "$DOMEFALL" preview fall.yaml --at 0:02 --out at.png --size 64x36
cmp -s frame.png at.png || fail "the end is not the last frame"
exits 2 "$DOMEFALL" preview fall.yaml --at 0:03 --out at.png
says '^--at 0:03: the show ends at 2 s \(0:02\)$'
exits 2 "$DOMEFALL" preview fall.yaml --at their --out at.png
says '^--at their: expected seconds, a time such as 1:02.5 or a marker \(there\)$'
exits 2 "$DOMEFALL" preview fall.yaml --frame 99 --out still.png
