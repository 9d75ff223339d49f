#!/usr/bin/env bash
# domefall preview: a flat still, the hole in its middle, whatever the show's own projection.
source "$(dirname "$0")/common.bash"
write_show fall.yaml
exits 0 "$DOMEFALL" preview fall.yaml --frame 6 --out still.png --size 320x180
exits 0 identify -format '%wx%h %z' still.png
[ "$(cat stdout)" = '320x180 16' ] || fail "the still is $(cat stdout)"
convert still.png -depth 16 -endian LSB rgb:still.rgb
python3 - <<'END'
codes = memoryview(open('still.rgb', 'rb').read()).cast('H')
def light(x, y):
    return sum(codes[3 * (320 * y + x):][:3])
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
