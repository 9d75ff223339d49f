#!/usr/bin/env bash
# A dome's own light: render, grade and preview add it or take it away, and only graded frames change.
# shellcheck source=tests/cli/common.bash
source "$(dirname "$0")/common.bash"
cd "$folder"
write_show plain.yaml
sed 's/A short fall/A short fall in a dome/' plain.yaml >fall.yaml
{ cat fall.yaml; echo 'dome: {light: simulate}'; } >simulate.yaml
{ cat fall.yaml; echo 'dome: {light: compensate}'; } >compensate.yaml

# light IMAGE: the mean of its 16-bit codes
light() {
  python3 - "$1" <<'END2'
import struct, sys, zlib
data = open(sys.argv[1], 'rb').read()
width, height = struct.unpack('>II', data[16:24])
at, packed = 8, b''
while at < len(data):
    size, kind = struct.unpack('>I4s', data[at:at + 8])
    if kind == b'IDAT':
        packed += data[at + 8:at + 8 + size]
    at += 12 + size
raw, stride, above, total = zlib.decompress(packed), width * 6, bytes(width * 6), 0
for y in range(height):
    kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
    for x in range(stride):
        a, b = line[x - 6] if x >= 6 else 0, above[x]
        c = above[x - 6] if x >= 6 else 0
        p = a + b - c
        paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
        line[x] = (line[x] + (0, a, b, (a + b) // 2, paeth)[kind]) & 255
    above = bytes(line)
    total += sum(struct.unpack(f'>{3 * width}H', above))
print(total // (3 * width * height))
END2
}
ordered() { # ordered COMPENSATED PLAIN SIMULATED: three images, from dark to bright
  [ "$(light "$1")" -lt "$(light "$2")" ] || fail "$1 is not darker than $2"
  [ "$(light "$2")" -lt "$(light "$3")" ] || fail "$3 is not brighter than $2"
}

for show in fall simulate compensate; do
  cp $show.yaml show.yaml
  exits 0 "$DOMEFALL" render show.yaml --frames 2 --out $show --threads 2
  exits 0 "$DOMEFALL" preview show.yaml --frame 2 --size 64x36 --out $show.png
done
ordered {compensate,fall,simulate}/graded/show_00002.png
ordered compensate.png fall.png simulate.png
for show in simulate compensate; do
  cmp -s fall/linear/show_00002.exr $show/linear/show_00002.exr || fail "$show changes the light"
done

# Any number of threads gives the same bytes, and so does grading again, which is done only once.
cp simulate.yaml show.yaml
exits 0 "$DOMEFALL" render show.yaml --frames 2 --out single --threads 1
same_frames single/graded simulate/graded
exits 0 "$DOMEFALL" grade show.yaml --frames 2 --out fall
says '^1 frames made'
same_frames fall/graded simulate/graded
exits 0 "$DOMEFALL" grade show.yaml --frames 2 --out fall
says '^0 frames made'

# Without it frames have the grade that they had before there was such a thing.
{ cat fall.yaml; echo 'dome: {light: none, reflectance: 0.3}'; } >show.yaml
exits 0 "$DOMEFALL" render show.yaml --frames 2 --out none
cp fall.yaml show.yaml
exits 0 "$DOMEFALL" render show.yaml --frames 2 --out none
says '^0 frames made'
echo 'camera: {projection: stereographic}' >>simulate.yaml
exits 2 "$DOMEFALL" check simulate.yaml
says 'simulate.yaml:[0-9]+:[0-9]+: dome.light is for domes; this projection is flat$'
