#!/usr/bin/env bash
# HDR from the show to the movie: PNGs say cICP, and ffprobe reads the tags, the screen and the light levels back,
# which are held against those of the PNGs by the formula of ST 2084.
source "$(dirname "$0")/common.bash"

# The example of docs/movies.md.
awk '/^## HDR/ {here = 1} here && /^```$/ {exit} text {print} here && /^```yaml/ {text = 1}' \
  "$DOMEFALL_SOURCE/docs/movies.md" >hdr.yaml
grep -q 'Rec.2100 PQ 1000 nits' hdr.yaml || fail "no example in docs/movies.md"
probe() { # probe MOVIE: tags and light levels, a line each
  ffprobe -v error -select_streams v:0 -show_entries stream=pix_fmt,color_range,color_primaries,color_transfer,color_space \
    -read_intervals '%+#1' -show_frames -of default=noprint_wrappers=1 "$1"
}

sed -i "s/duration_s: 1/&, exposure: {ev: 5}/" hdr.yaml  # a brighter sky, with highlights
exits 0 "$DOMEFALL" render hdr.yaml --size 128 --frames 0-2 --out frames
exits 0 "$DOMEFALL" movie hdr.yaml --size 128 --frames 0-2 --preset dome --from frames --out pq.mp4
says 'colour: primaries bt2020, transfer smpte2084 \(PQ\), matrix bt2020nc'
says 'light levels: MaxCLL'
probe pq.mp4 >tags
for tag in pix_fmt=yuv420p10le color_range=tv color_primaries=bt2020 color_transfer=smpte2084 color_space=bt2020nc; do
  grep -q "^$tag$" tags || fail "no $tag: $(cat tags)"
done

cat >measure.py <<'END'
import glob, math, re, struct, subprocess
def light(code):
    m1, m2, c1, c2, c3 = 0.1593017578125, 78.84375, 0.8359375, 18.8515625, 18.6875
    p = code ** (1 / m2)
    return 10000 * (max(p - c1, 0) / (c2 - c3 * p)) ** (1 / m1)
most = mean = 0
files = sorted(glob.glob('frames/**/*.png', recursive=True))
assert len(files) == 3, files
for name in files:
    data = open(name, 'rb').read()
    at = data.find(b'cICP')
    assert 0 < at < data.find(b'IDAT') and data[at + 4:at + 8] == bytes([9, 16, 0, 1]), name
    assert b'gAMA' not in data[:data.find(b'IDAT')], name
    raw = subprocess.run(['ffmpeg', '-v', 'error', '-i', name, '-f', 'rawvideo', '-pix_fmt', 'rgb48le', '-'],
                         check=True, capture_output=True).stdout
    codes = struct.unpack('<%dH' % (len(raw) // 2), raw)
    lights = [light(max(codes[k:k + 3]) / 65535) for k in range(0, len(codes), 3)]
    most, mean = max(most, max(lights)), max(mean, sum(lights) / len(lights))
tags = dict(line.split('=', 1) for line in open('tags').read().split('\n') if '=' in line)
assert int(tags['max_content']) == math.ceil(most), (tags, most)
assert int(tags['max_average']) == math.ceil(mean), (tags, mean)
assert 100 < most <= 1001, most  # more than SDR has
print('MaxCLL', most, 'MaxFALL', mean)
END
"${DOMEFALL_PYTHON:-python3}" measure.py

# The screen that the grade is made for (ST 2086): the primaries of BT.2020, and white at 1000 cd/m^2.
for line in red_x=35400 red_y=14600 green_x=8500 green_y=39850 blue_x=6550 blue_y=2300 white_point_x=15635 \
  white_point_y=16450; do
  grep -q "^$line/50000$" tags || fail "no $line: $(cat tags)"
done
grep -q '^max_luminance=10000000/10000$' tags || fail "$(cat tags)"

# Frames that are rendered for a movie have the same levels, which the movie gets at its end.
levels=$(grep '^max_[ac]' tags)
exits 0 "$DOMEFALL" movie hdr.yaml --size 128 --frames 0-2 --preset dome --out rendered.mp4
says 'light levels: MaxCLL'
probe rendered.mp4 >tags
[ "$(grep '^max_[ac]' tags)" = "$levels" ] || fail "not $levels: $(cat tags)"
! grep -q 65534 rendered.mp4 || fail "it still has the levels that it was begun with"

# Those of another screen, and HLG, which has neither levels nor a screen.
sed 's/Rec.2100 PQ 1000/Rec.2100 PQ 500/' hdr.yaml >half.yaml
exits 0 "$DOMEFALL" movie half.yaml --size 64 --frames 0 --preset dome --out half.mp4
probe half.mp4 >tags
grep -q '^max_luminance=5000000/10000$' tags || fail "$(cat tags)"
sed 's/Rec.2100 PQ 1000 nits/Rec.2100 HLG 1000 nits/' hdr.yaml >hlg.yaml
exits 0 "$DOMEFALL" movie hlg.yaml --size 64 --frames 0 --preset dome --out hlg.mp4
probe hlg.mp4 >tags
grep -q '^color_transfer=arib-std-b67$' tags || fail "$(cat tags)"
! grep -q 'max_content\|max_luminance' tags || fail "$(cat tags)"
# A newer configuration is refused with its place before work begins.
sed 's/^ocio_profile_version: 2.1/ocio_profile_version: 2.99/' "$DOMEFALL_SOURCE/shows/assets/dome.ocio" >newer.ocio
printf 'grade: {config: newer.ocio}\ntimeline: [{duration_s: 1}]\n' >newer.yaml
exits 2 "$DOMEFALL" check newer.yaml
says 'newer.ocio: line 1: a configuration of version 2.99 needs OpenColorIO 2.99 or newer'
