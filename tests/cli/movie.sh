#!/usr/bin/env bash
# domefall movie: each preset is decoded again and held against the frames; frames that are missing, damaged or
# changed, a full disk, a missing ffmpeg and a stopped run are told, and leave no movie behind.
source "$(dirname "$0")/common.bash"

# Strong colours, by which a wrong matrix shows, without edges, at which codecs err.
ffmpeg -v error -f lavfi -i 'color=s=128x64,format=gbrp,geq=r=128+120*sin(X/128*6.2832):g=128+120*sin(X/64*6.2832):b=4*Y' \
  -frames:v 1 colours.png
"$DOMEFALL" sky import colours.png --size 64 --out colours.sky 2>/dev/null
write_movie_show() { # write_movie_show FILE [LINE...]: 8 frames of 64 pixels
  cat >"$1" <<END
title: "A film: 50% 'black'"
frames_per_second: 23.976
size: 64
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {background: colours.sky, stars: none}}
timeline: [{duration_s: 0.333667, trajectory: {type: infall, from_r: 6, to_r: 1.5}}]
END
  printf '%s\n' "${@:2}" >>"$1"
}
movie=("$DOMEFALL" movie a.yaml)
nothing() { # nothing FILE: neither the movie nor a part of it is there
  [ ! -e "$1" ] || fail "$1 is there"
  [ -z "$(find . -name '.*.tmp')" ] || fail "left: $(find . -name '.*.tmp')"
}
tone() { # tone FILE SECONDS FREQUENCY [CHANNELS]
  ffmpeg -v error -nostdin -y -f lavfi -i "sine=f=$3:r=48000:d=$2" -ac "${4:-1}" -c:a pcm_s16le "$1"
}

# What a movie says of itself, and the difference of its first and last picture from the frames.
cat >look.py <<'END'
import json, subprocess, sys

def probe(movie):
    out = subprocess.run(['ffprobe', '-v', 'error', '-count_frames', '-show_streams', '-show_format', '-of', 'json', movie],
                         check=True, capture_output=True).stdout
    return json.loads(out)

def pictures(source, filters, width, height):
    """Codes from 0 to 1, picture by picture."""
    out = subprocess.run(['ffmpeg', '-v', 'error', '-i', source, *filters, '-f', 'rawvideo', '-pix_fmt', 'rgb48le', '-'],
                         check=True, capture_output=True).stdout
    size = width * height * 6
    assert len(out) % size == 0
    return [memoryview(out[k:k + size]).cast('H') for k in range(0, len(out), size)]

movie, codec, profile, tag, pixels, range_, matrix, transfer, primaries, error = sys.argv[1:11]
frames = sys.argv[11:]
facts = probe(movie)
video = facts['streams'][0]
assert facts['format']['tags']['title'] == "A film: 50% 'black'", facts['format']['tags']
for key, value in {'codec_name': codec, 'codec_tag_string': tag, 'pix_fmt': pixels, 'color_range': range_,
                   'color_space': matrix, 'color_transfer': transfer, 'color_primaries': primaries,
                   'r_frame_rate': '24000/1001', 'avg_frame_rate': '24000/1001', 'nb_read_frames': '8',
                   'width': 64, 'height': 64}.items():
    found = video.get(key, 'unknown')
    assert found == value or value == '-', (movie, key, found, value)
assert profile == '-' or video['profile'] == profile, video['profile']
is_rgb = matrix in ('gbr', '-')
decode = [] if is_rgb else ['-vf', 'zscale=matrixin=' + {'bt709': '709', 'bt2020nc': '2020_ncl'}[matrix] +
                            ':rangein=limited,format=gbrp16le']
decoded = pictures(movie, decode, 64, 64)
assert len(decoded) == 8
for frame, picture in ((frames[0], decoded[0]), (frames[-1], decoded[-1])):
    wanted, = pictures(frame, [], 64, 64)
    if codec == 'h264':  # what is written in the corners leaves the middle free
        wanted, picture = (p[26 * 64 * 3:38 * 64 * 3] for p in (wanted, picture))
    mean = sum(abs(a - b) for a, b in zip(wanted, picture)) / len(wanted) / 65535
    assert mean < float(error), (movie, frame, mean)
    # A wrong matrix or range shifts whole channels, which a codec does not.
    for channel in range(3):
        shift = (sum(picture[channel::3]) - sum(wanted[channel::3])) / len(wanted) * 3 / 65535
        assert abs(shift) < float(error) / 3, (movie, frame, channel, shift)

END

# Every preset, from finished frames.  Chroma of half the size costs most of the error: the disc's rim is sharp.
write_movie_show a.yaml
exits 0 "$DOMEFALL" render a.yaml --out a
frames=(a/graded/a_0000?.png)
[ ${#frames[@]} -eq 8 ] || fail "${#frames[@]} frames"
for preset in review dome dome8k; do
  exits 0 "${movie[@]}" --from a --preset $preset --out $preset.mp4
  says 'primaries bt709, transfer bt470m \(gamma 2\.2\), matrix bt709, range limited$'
  says '^8 frames, 0\.334 s at 24000/1001 a second, made in .* s: '
done
for preset in master hap; do exits 0 "${movie[@]}" --from a --preset $preset --out $preset.mov; done
python3 look.py dome.mp4 hevc 'Main 10' hvc1 yuv420p10le tv bt709 bt470m bt709 0.03 "${frames[@]}"
python3 look.py dome8k.mp4 hevc 'Main 10' hvc1 yuv420p10le tv bt709 bt470m bt709 0.03 "${frames[@]}"
# ProRes has one range and no tag for it, which ffprobe 5 calls tv and ffprobe 7 unknown.
python3 look.py master.mov prores 4444 ap4h yuv444p12le - bt709 bt470m bt709 0.012 "${frames[@]}"
python3 look.py hap.mov hap - HapY rgb0 - gbr bt470m bt709 0.02 "${frames[@]}"
python3 look.py review.mp4 h264 High avc1 yuv420p tv bt709 bt470m bt709 0.05 "${frames[@]}"
[ "$(head -c 4096 dome.mp4 | grep -c moov)" -ge 1 ] || fail "dome.mp4 does not begin with its index"

# A rate that ffmpeg takes for 120 unless it is told.
sed 's/^frames_per_second: .*/frames_per_second: 119.88/' a.yaml >fast.yaml
exits 0 "$DOMEFALL" movie fast.yaml --preset master --out fast.mov
[ "$(ffprobe -v error -show_entries stream=r_frame_rate -of csv=p=0 fast.mov)" = 120000/1001 ] ||
  fail "the rate of fast.mov"

# Straight from the renderer: the same movie.
exits 0 "${movie[@]}" --preset master --out straight.mov
cmp -s straight.mov master.mov || fail "a movie of frames that were rendered for it is another"
[ "$(find . -name '*.exr' | wc -l)" -eq 8 ] || fail "movie writes frames"

# Other kinds of frames, a part of them, another display, and default names.
for kind in tiff8:0.012 jpeg:0.03; do
  write_movie_show b.yaml "output: {linear: none, graded: ${kind%:*}}"
  exits 0 "$DOMEFALL" render b.yaml --out "${kind%:*}"
  exits 0 "$DOMEFALL" movie b.yaml --from "${kind%:*}" --preset master --out b.mov
  python3 look.py b.mov prores 4444 ap4h yuv444p12le - bt709 bt470m bt709 "${kind#*:}" "${frames[@]}"
done
write_movie_show wide.yaml "grade: {display: Dome G2.4 Rec.2020}"
exits 0 "$DOMEFALL" render wide.yaml --out wide
exits 0 "$DOMEFALL" movie wide.yaml --preset dome
python3 look.py out/wide_dome.mp4 hevc 'Main 10' hvc1 yuv420p10le tv bt2020nc bt2020-10 bt2020 0.03 wide/graded/*.png
write_movie_show p3.yaml "grade: {display: Dome G2.6 P3-D65}"
exits 0 "$DOMEFALL" movie p3.yaml --preset review --frames 2-3
says "^the display 'Dome G2.6 P3-D65' with the view 'Dome' has no tag in video for its curve; "
exits 2 "${movie[@]}" --preset review --frames 0-6x2
says '^--frames 0-6x2: the frames of a movie follow one another'
exits 2 "${movie[@]}" --preset review --out a.mov
says '^--out a.mov: a movie of the preset review is a .mp4 file$'
exits 2 "${movie[@]}" --preset hap --size 63
says '^--size: the preset hap takes widths and heights that are multiples of 4'

# A frame's number is written on it: the corners of the first and last differ, and from the dome preset's black.
# The number stands behind "frame", whose width is the font's.
ffmpeg -v error -i review.mp4 -vf crop=40:16:0:0 -f rawvideo -pix_fmt gray - >corners
[ "$(head -c 640 corners | cmp -l - <(tail -c 640 corners) 2>/dev/null | wc -l)" -gt 0 ] || fail "no numbers are burnt in"
[ "$(head -c 640 corners | tr -d '\020\000-\017' | wc -c)" -gt 20 ] || fail "nothing is written in the corner"

# Sound: one file, six channels by their names in any order, and lengths.
tone stereo.wav 0.333667 440 2
exits 0 "${movie[@]}" --from a --preset master --audio stereo.wav --out sound.mov
k=0
for name in show_Rs show_LFE show_L show_C show_Ls show_R; do
  k=$((k + 1))
  tone $name.wav 0.333667 $((k * 100))
done
exits 0 "${movie[@]}" --from a --preset master --audio show_*.wav --out six.mov
exits 0 "${movie[@]}" --from a --preset dome --audio show_*.wav --out six.mp4
python3 - <<'END'
import array, json, subprocess
def sound(movie):
    out = subprocess.run(['ffprobe', '-v', 'error', '-select_streams', 'a', '-show_entries',
                          'stream=channels,channel_layout,codec_name,duration', '-of', 'json', movie],
                         check=True, capture_output=True).stdout
    return json.loads(out)['streams'][0]
for movie, codec, channels, layout in (('sound.mov', 'pcm_s24le', 2, 'stereo'), ('six.mov', 'pcm_s24le', 6, '5.1'),
                                       ('six.mp4', 'aac', 6, '5.1')):
    found = sound(movie)
    assert (found['codec_name'], found['channels'], found.get('channel_layout')) == (codec, channels, layout), found
    assert abs(float(found['duration']) - 8 * 1001 / 24000) < 1e-3, (movie, found)
pcm = array.array('h', subprocess.run(['ffmpeg', '-v', 'error', '-i', 'six.mov', '-f', 's16le', '-'], check=True,
                                      capture_output=True).stdout)
for channel, tone in enumerate((300, 600, 400, 200, 500, 100)):  # L R C LFE Ls Rs
    one = pcm[channel::6]
    rises = sum(a < 0 <= b for a, b in zip(one, one[1:]))
    assert abs(rises / (len(one) / 48000) - tone) < 10, (channel, rises, tone)
END
tone long.wav 0.4 440
exits 2 "${movie[@]}" --from a --preset master --audio long.wav --out no.mov
says '^long.wav: the sound lasts 0\.400 s, and the show 0\.334 s \(8 frames at 24000/1001 a second\); it may be longer '
tone short.wav 0.2 440
exits 0 "${movie[@]}" --from a --preset master --audio short.wav --frames 2-7 --out short.mov
says '^short.wav: the sound lasts 0\.200 s, and the show 0\.334 s .*; the rest is silent$'
exits 2 "${movie[@]}" --preset master --audio sound.mov --out sound.mov
says '^--out sound.mov: that is the file to be read'

# Frames that cannot be used are named before ffmpeg begins, and a change meanwhile is seen.
cp -r a b
rm b/graded/a_0000[23].png b/graded/a_00006.png
printf x | dd of=b/graded/a_00005.png bs=1 seek=2000 conv=notrunc 2>/dev/null
exits 75 "${movie[@]}" --from b --preset master --out no.mov
says '^b: 4 of 8 frames cannot be used$'
says '^  missing: 2-3,6$'
says '^  damaged: 5$'
exits 75 "$DOMEFALL" movie a.yaml --from nowhere --preset master --out no.mov
says '^  missing: 0-7$'
exits 0 "${movie[@]}" --from b --preset master --frames 0-1 --out part.mov
sed 's/to_r: 1.5/to_r: 1.4/' a.yaml >c.yaml
cp -r a c
for frame in c/graded/*; do mv "$frame" "${frame/a_/c_}"; done
exits 75 "$DOMEFALL" movie c.yaml --from c --preset master --out no.mov
says '^  of another version of the show or of its grade: (0|1)-7$'
exits 2 "${movie[@]}" --from a --size 128 --preset master --out no.mov
says '^such as a/graded/a_00000.png \(64 x 64 pixels\); this movie takes 128 x 128 pixels'
write_movie_show d.yaml "output: {graded: none}"
exits 2 "$DOMEFALL" movie d.yaml --from a --preset master --out no.mov
says '^d.yaml: keeps no graded frames'
nothing no.mov

# Programs that stand in for ffmpeg: one that is not there, one that lacks an encoder, one that fails in the
# middle, and one that is slow.
real=$(command -v ffmpeg)
mkdir bin none
ln -s "$(command -v ffprobe)" bin/ffprobe
PATH=none exits 75 "${movie[@]}" --preset master --out no.mov
says "^the program ffmpeg is not on the PATH; Debian's package ffmpeg has it$"
PATH=none exits 75 "$DOMEFALL" farm submit a.yaml --engine local --movie review --out no.frames
says "^the program ffmpeg is not on the PATH; Debian's package ffmpeg has it$"
ln -s "$(command -v ffmpeg)" none/ffmpeg # which cannot count the frames of what it has made
PATH=none exits 75 "${movie[@]}" --preset master --out no.mov
says "^the program ffprobe is not on the PATH; Debian's package ffmpeg has it$"
instead() { # instead COMMAND...: what runs when a movie is made; a trial is as it was
  printf '#!/bin/bash\ncase "$*" in -version) exit ;; *128x128*) %s ;; *) %s ;; esac\n' \
    "${2:-exec $real \"\$@\"}" "$1" >bin/ffmpeg
  chmod +x bin/ffmpeg
}
instead '' 'echo "Unknown encoder" >&2; exit 1' # as one without x264 and x265
PATH="$PWD/bin:$PATH" exits 75 "${movie[@]}" --preset master --out no.mov
says '^the programs of this machine cannot make the preset master, which needs the encoder prores_ks .*ended with code 1:$'
says '^Unknown encoder$'
PATH="$PWD/bin:$PATH" exits 75 "$DOMEFALL" farm submit a.yaml --engine local --movie master --out no.frames --dry-run
says '^the programs of this machine cannot make the preset master, '
[ ! -e no.frames ] || fail "frames were begun"
instead 'head -c 30000 >/dev/null; echo one >&2; echo "the very last line" >&2; exit 3'
PATH="$PWD/bin:$PATH" exits 1 "${movie[@]}" --preset master --out no.mov
says '^no.mov: after [0-9] of 8 frames ffmpeg ended with code 3:$'
says '^the very last line$'
instead 'cat >/dev/null' # it writes nothing, and is content
PATH="$PWD/bin:$PATH" exits 75 "${movie[@]}" --preset master --out no.mov
says '^no.mov: ffmpeg was given 8 frames, and the movie that it wrote has none that can be read; nothing was kept'
instead 'yes "a long complaint" | head -n 100000 >&2; kill -9 $$'
PATH="$PWD/bin:$PATH" exits 75 "${movie[@]}" --preset master --out no.mov
says '^no.mov: after [0-9] of 8 frames ffmpeg was ended by signal 9 \(Killed\):$'
# A frame is larger than a pipe can hold (1 MiB), so the last one is not read before ffmpeg takes the first.
exits 0 "$DOMEFALL" render a.yaml --size 512 --out large
instead 'rm large/graded/a_00007.png; exec cat >/dev/null'
PATH="$PWD/bin:$PATH" exits 75 "${movie[@]}" --from large --size 512 --preset master --threads 1 --out no.mov
says '^large/graded/a_00007.png: the file was changed or removed meanwhile; run again$'
nothing no.mov

# Stopped in the middle: no ffmpeg goes on, and no movie is there.
instead 'echo $$ >running; exec sleep 60'
for signal in TERM INT KILL; do
  rm -f running
  PATH="$PWD/bin:$PATH" python3 -c '
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
os.execvp(sys.argv[1], sys.argv[1:])' "${movie[@]}" --preset master --out no.mov 2>stderr &
  until [ -s running ]; do kill -0 $! || fail "$(cat stderr)"; sleep 0.01; done
  kill -$signal $!
  wait $! 2>/dev/null && fail "it ended well"
  for _ in $(seq 100); do [ -e "/proc/$(cat running)/exe" ] || break; sleep 0.02; done
  [ ! -e "/proc/$(cat running)/exe" ] || fail "after SIG$signal ffmpeg goes on"
  [ $signal = KILL ] || nothing no.mov
  [ ! -e no.mov ] || fail "SIG$signal leaves a movie"
done
exits 0 "${movie[@]}" --preset master --frames 0-1 --out no.mov # and removes what the kill has left
rm no.mov
nothing no.mov

# A full disk.
full() {
  mkdir small
  mount -t tmpfs -o size=16k none small
  exits 75 "${movie[@]}" --from a --preset master --out small/no.mov
  says '^small/no.mov: .*ffmpeg'
  says 'No space left on device'
  [ -z "$(find small -type f)" ] || fail "left: $(find small)"
  # What cannot end is not begun.
  sed 's/duration_s: 0.333667/duration_s: 2000/' a.yaml >hours.yaml
  exits 75 "$DOMEFALL" movie hours.yaml --preset master --size 512 --out small/no.mov
  says '^small/no.mov: .* free on this disk, and a movie of 47952 frames of 512 x 512 pixels takes at least '
  for options in '' '--dry-run'; do
    # shellcheck disable=SC2086 # perhaps none
    exits 75 "$DOMEFALL" farm submit hours.yaml --engine local --out small/frames $options
    says '/small/frames: .* free on this disk, and 47952 frames take '
  done
  [ ! -e small/frames ] || fail "frames were begun"
}
if unshare --mount true 2>stderr; then
  export -f full exits says fail
  export folder DOMEFALL
  # shellcheck disable=SC2016  # the inner shell expands
  unshare --mount bash -c 'set -euo pipefail; movie=("$DOMEFALL" movie a.yaml); full'
fi

# Markers are chapters, whatever their names, and QuickTime files have the time code of their first frame.
cat >chapters.yaml <<'END'
title: Chapters
frames_per_second: 24
size: 64
sky: {region_I: {background: grid, stars: none}}
markers: {"door; opens=#1": 1, "[CHAPTER]": 2}
timeline: [{duration_s: 3}]
END
chapters_of() {
  ffprobe -v error -show_chapters -of json "$1" |
    jq -r '.chapters[] | "\(.start_time | tonumber * 1000 | round) \(.end_time | tonumber * 1000 | round) \(.tags.title)"'
}
exits 0 "$DOMEFALL" movie chapters.yaml --preset review --out all.mp4
exits 0 "$DOMEFALL" movie chapters.yaml --preset master --out all.mov
printf '%s\n' '0 1000 Chapters' '1000 2000 door; opens=#1' '2000 3000 [CHAPTER]' >expected
for movie in all.mp4 all.mov; do
  chapters_of $movie | cmp - expected || fail "chapters of $movie: $(chapters_of $movie)"
done
exits 0 "$DOMEFALL" movie chapters.yaml --preset master --frames 30-59 --out part.mov
printf '%s\n' '0 750 door; opens=#1' '750 1250 [CHAPTER]' >expected
chapters_of part.mov | cmp - expected || fail "chapters of a part: $(chapters_of part.mov)"
exits 0 ffprobe -v error -select_streams d -show_entries stream_tags=timecode -of csv=p=0 part.mov
tells '^00:00:01:06'
