#!/usr/bin/env bash
# domefall movie --preset vr360: a movie that players know for a whole sphere.
source "$(dirname "$0")/common.bash"
command -v ffmpeg >/dev/null && command -v mkvmerge >/dev/null || exit 77
nothing_left() {
  [ ! -e "$1" ] || fail "$1 is there"
  [ -z "$(find . -name '.*.tmp')" ] || fail "left: $(find . -name '.*.tmp')"
}

cat >sphere.yaml <<END
title: Around
frames_per_second: 29.97
size: 128
black_hole: {mass_solar: 4.3e6}
camera: {projection: equirectangular}
sky: {region_I: {background: grid, stars: none}}
timeline: [{duration_s: 0.2669, trajectory: {type: infall, from_r: 6, to_r: 4}}]
END
ffmpeg -v error -f lavfi -i 'sine=r=48000:d=0.267' -c:a pcm_s16le sound.wav
exits 0 "$DOMEFALL" movie sphere.yaml --preset vr360 --audio sound.wav
[ "$(find . -name '.*.tmp')" = "" ] || fail "left: $(find . -name '.*.tmp')"
ffprobe -v error -count_packets -show_streams -show_format -of json out/sphere_vr360.mkv >facts
python3 - facts <<'END'
import json, sys
facts = json.load(open(sys.argv[1]))
video, sound = facts['streams']
for key, value in {'codec_name': 'hevc', 'profile': 'Main 10', 'pix_fmt': 'yuv420p10le', 'width': 128,
                   'height': 64, 'color_range': 'tv', 'color_space': 'bt709', 'color_transfer': 'bt470m',
                   'color_primaries': 'bt709', 'r_frame_rate': '30000/1001',
                   'avg_frame_rate': '30000/1001', 'nb_read_packets': '8'}.items():
    assert video.get(key) == value, (key, video.get(key), value)
assert [d.get('projection') for d in video['side_data_list']] == ['equirectangular'], video
assert sound['codec_name'] == 'aac' and sound['sample_rate'] == '48000', sound
assert facts['format']['tags']['title'] == 'Around', facts['format']
END

# An .mp4 that is taken from it is a sphere, too.
ffmpeg -v error -i out/sphere_vr360.mkv -c copy -tag:v hvc1 -strict unofficial sphere.mp4
ffprobe -v error -show_streams sphere.mp4 >taken
grep -q '^projection=equirectangular' taken || fail "the .mp4 is no sphere"

exits 2 "$DOMEFALL" movie sphere.yaml --preset vr360 --out sphere.mp4
says '^--out sphere.mp4: a movie of the preset vr360 is a .mkv file$'

# A title is a title, whatever programs take it for.
echo 'keep me' >kept.txt
printf '%s\n' --output kept.txt >options.txt
for title in '@options.txt' '@/etc/passwd' --preset -y -o --output -h -r -w --list-types "a'b\"c" "\`touch x\`" "\$(touch x)" '%s %d' '[0:v]' 'text=' 'a=b;c' 'a\b'; do
  python3 - "$title" <<'PY'
import json, sys
show = open("sphere.yaml").read()
open("titled.yaml", "w").write(show.replace("title: Around", "title: " + json.dumps(sys.argv[1])))
PY
  exits 0 "$DOMEFALL" movie titled.yaml --preset vr360 --frames 0 --out titled.mkv
  found=$(ffprobe -v error -show_entries format_tags=title -of default=nw=1:nk=1 titled.mkv)
  [ "$found" = "$title" ] || fail "the title is $found, not $title"
  exits 0 "$DOMEFALL" movie titled.yaml --preset review --frames 0 --out titled.mp4
  found=$(ffprobe -v error -show_entries format_tags=title -of default=nw=1:nk=1 titled.mp4)
  [ "$found" = "$title" ] || fail "the title is $found, not $title"
done
[ "$(cat kept.txt)" = 'keep me' ] || fail "a title was obeyed by mkvmerge"
[ ! -e x ] || fail "a title was run"

# Without mkvmerge nothing is begun; where it fails, nothing is kept.
mkdir programs
ln -s "$(command -v ffmpeg)" "$(command -v ffprobe)" programs
for command in 'movie sphere.yaml --out none.mkv --preset vr360' \
  'farm submit sphere.yaml --engine local --out none --movie vr360'; do
  # shellcheck disable=SC2086 # several words
  exits 75 env PATH="$folder/programs" "$DOMEFALL" $command
  says 'mkvtoolnix'
done
[ ! -e none ] || fail "frames were begun"
nothing_left none.mkv
cat >programs/mkvmerge <<END
#!/bin/sh
[ "\$1" = --version ] && exit 0
echo 'Error: it does not want to.'
exit 2
END
chmod +x programs/mkvmerge
exits 75 env PATH="$folder/programs" "$DOMEFALL" movie sphere.yaml --preset vr360 --out none.mkv
says 'cannot make the preset vr360, .*ended with code 2'
says 'it does not want to'
# One that is content with the trial, and fails later.
sed -i "2a [ -e tried ] || { : >tried; exec $(command -v mkvmerge) \"\$@\"; }" programs/mkvmerge
exits 1 env PATH="$folder/programs" "$DOMEFALL" movie sphere.yaml --preset vr360 --out none.mkv
says '^.*none.mkv: mkvmerge, which says that it is a sphere, ended with code 2'
says 'it does not want to'
nothing_left none.mkv
