#!/usr/bin/env bash
# The folder for festivals and domes: what is in it, what is refused, and that nothing that is wrong
# with it later goes unseen, neither by Domefall nor by the script that goes with it.
source "$(dirname "$0")/common.bash"
write_flat_show fall.yaml 64 2
exits 0 "$DOMEFALL" render fall.yaml --out made

# wav FILE SECONDS: silence of one channel.
wav() { ffmpeg -v error -y -f lavfi -i anullsrc=r=48000:cl=mono -t "$2" -c:a pcm_s24le "$1"; }
wav show_L.wav 2
wav show_R.wav 2
printf '1\n00:00:00,500 --> 00:00:01,900\nDown we go\n' >en.srt

deliver() { "$DOMEFALL" deliver fall.yaml --from made "$@"; }
whole() { # whole DIR: both ways of checking find nothing wrong
  exits 0 "$DOMEFALL" deliver --check "$1"
  exits 0 sh "$1/verify.sh"
  (cd "$1" && sha256sum --quiet --strict -c checksums.sha256) || fail "$1: sha256sum"
}

# Frames as they are take no room; all else is there.
exits 0 deliver --out as_made --audio show_L.wav --audio show_R.wav --subtitles en.srt --leader
whole as_made
[ as_made/frames/fall_00008.png -ef made/graded/fall_00007.png ] || fail "no hard link"
[ "$(find as_made -type f | wc -l)" -eq $((8 + 32 + 3 + 7)) ] || fail "$(find as_made -type f)"
python3 - <<'END'
import json
said = json.load(open("as_made/metadata.json"))
assert said["title"] == "A short fall" and said["frames"] == 8 and said["duration_s"] == 2, said
assert said["frame_rate"] == {"numerator": 4, "denominator": 1}, said
assert (said["width"], said["height"], said["projection"]) == (64, 64, "domemaster"), said
assert said["front"] == "bottom" and said["dimensions"] == "2D", said
assert said["image"] == {"kind": "PNG", "bits_per_colour": 16, "channels": "RGB", "alpha": False}
assert [(a["channel"], a["sample_rate"], a["bits"]) for a in said["audio"]] == [
    ("L", 48000, 24), ("R", 48000, 24)], said
assert said["subtitles"][0]["end_s"] == 1.9 and said["leader"]["frames"] == 32, said
assert said["colour"]["transfer"] == "power 2.2", said
END
for words in 'A short fall' '4 frames a second' '64 x 64 pixels, 16 bits' 'BOTTOM of the picture = FRONT' \
  'power of 2.2' 'channel L, 48000 Hz' 'fall_00001.png to fall_00008.png'; do
  grep -qF "$words" as_made/README.txt || fail "README.txt does not say '$words'"
done
exits 0 pngcheck -q as_made/*.png as_made/leader/*.png
exits 0 identify -format '%wx%h %z' as_made/leader/fall_leader_00032.png
[ "$(cat stdout)" = "64x64 16" ] || fail "the leader is not as the frames are: $(cat stdout)"

# 24 bits are those that the renderer would have written.
printf '1\r00:00:00.50 --> 00:00:01\rright --> here \303\251\r\r2\r00:00:00,8 --> 00:00:01,9\rx' >narrow.srt
iconv -f UTF-8 -t UTF-16 narrow.srt >wide.srt
exits 0 deliver --out in_24_bits --depth 8 --name 'my_show_######_v2' --threads 2 --subtitles wide.srt
says '^wide.srt: the text is UTF-16, and is delivered as UTF-8$'
says '^wide.srt: line 6: the subtitle begins before the one before it ends$'
cmp narrow.srt in_24_bits/subtitles/wide.srt || fail "the subtitles were not made UTF-8"
whole in_24_bits
sed 's/linear: none/&, graded: png8/' fall.yaml >eight.yaml && mv eight.yaml 8.yaml
mkdir eight && sed 's/linear: none/&, graded: png8/' fall.yaml >eight/fall.yaml
exits 0 "$DOMEFALL" render eight/fall.yaml --out eight
cmp in_24_bits/frames/my_show_000003_v2.png eight/graded/fall_00002.png
exits 0 pngcheck in_24_bits/frames/my_show_000001_v2.png
grep -q '(64x64, 24-bit RGB, ' stdout || fail "not 24 bits: $(cat stdout)"
exits 2 "$DOMEFALL" deliver eight/fall.yaml --from eight --out deeper --depth 16
says 'frames have 8 bits'

# TIFF and JPEG go the same way.
for kind in tiff16:tif:8 tiff8:tif:8 jpeg:jpg:8; do
  IFS=: read -r name extension bits <<<"$kind"
  mkdir "$name" && sed "s/linear: none/&, graded: $name/" fall.yaml >"$name/fall.yaml"
  exits 0 "$DOMEFALL" render "$name/fall.yaml" --out "$name"
  exits 0 "$DOMEFALL" deliver "$name/fall.yaml" --from "$name" --out "$name/delivered" --depth "$bits"
  whole "$name/delivered"
  exits 0 identify -format '%z' "$name/delivered/frames/fall_00008.$extension"
  [ "$(cat stdout)" = 8 ] || fail "$name: $(cat stdout) bits"
done
cmp tiff16/delivered/frames/fall_00008.tif tiff8/graded/fall_00007.tif

# faulty PATTERN: both ways of checking find it in the copy, which is made anew.
faulty() {
  exits 2 "$DOMEFALL" deliver --check copy
  says "$1"
  exits 1 sh copy/verify.sh
  rm -r copy && cp -r as_made copy
}
cp -r as_made copy
whole copy
touch copy/.DS_Store
whole copy
printf x | dd of=copy/frames/fall_00003.png bs=1 seek=900 conv=notrunc status=none
faulty 'frames changed or damaged: 3$'
rm copy/frames/fall_00002.png copy/frames/fall_0000[5-7].png
faulty 'frames missing: 2,5-7$'
cp copy/frames/fall_00004.png copy/frames/fall_00009.png
faulty 'not of this delivery: frames/fall_00009.png'
cp copy/frames/fall_00004.png 'copy/a stray.png'
faulty 'not of this delivery: a stray.png'
cp copy/frames/fall_00004.png copy/frames/fall_00005.png
faulty 'frames that are copies of others: 5|frames changed or damaged: 5'
rm copy/audio/show_L.wav
faulty 'missing: audio/show_L.wav'
echo >>copy/README.txt
faulty 'changed: README.txt'
rm copy/checksums.sha256
faulty 'checksums.sha256 is missing'
sed -i '/fall_00004/d' copy/checksums.sha256
faulty 'does not list frames/fall_00004.png'
rm copy/metadata.json
faulty 'metadata.json does not say'

# A list that was made anew over a wrong folder does not hide what is wrong.
renewed() { (cd copy && cut -c67- checksums.sha256 | while read -r f; do [ ! -f "$f" ] || sha256sum "$f"; done >new && mv new checksums.sha256); }
cp copy/frames/fall_00004.png copy/frames/fall_00005.png && renewed
exits 2 "$DOMEFALL" deliver --check copy
says 'frames that are copies of others: 5$'
exits 0 "$DOMEFALL" render eight/fall.yaml --size 32 --frames 4 --out small
cp small/graded/fall_00004.png copy/frames/fall_00005.png && renewed
cp in_24_bits/frames/my_show_000006_v2.png copy/frames/fall_00006.png && renewed
convert as_made/frames/fall_00007.png copy/frames/fall_00007.png && renewed
exits 2 "$DOMEFALL" deliver --check copy
says 'frames changed or damaged: 7$'
says 'frames of another number, show, size, depth or kind than metadata.json says: 5-6$'
rm copy/frames/fall_00008.png && renewed
exits 2 "$DOMEFALL" deliver --check copy
says 'frames missing: 8$'
rm -r copy && cp -r as_made copy
(cd copy/frames && mv fall_00002.png x && mv fall_00003.png fall_00002.png && mv x fall_00003.png) && renewed
exits 2 "$DOMEFALL" deliver --check copy
says 'frames of another number, show, size, depth or kind than metadata.json says: 2-3$'
rm -r copy && cp -r as_made copy
rm -r copy/audio copy/preview.png && renewed
exits 2 "$DOMEFALL" deliver --check copy
says "checksums.sha256 lists [0-9]+ files, and metadata.json says $(wc -l <as_made/checksums.sha256)\$"
rm -r copy && cp -r as_made copy
mv copy/frames/fall_00002.png elsewhere.png && ln -s "$PWD/elsewhere.png" copy/frames/fall_00002.png
faulty 'frames/fall_00002.png is a link'

# Nor does the script believe a list that it cannot read, or a sum that nobody took.
sed -i '3s/^./g/' copy/checksums.sha256
exits 1 sh copy/verify.sh
rm -r copy && cp -r as_made copy
sed -i '3{h;d};4{G;s/\n.*//;p}' copy/checksums.sha256
exits 1 sh copy/verify.sh
rm -r copy && cp -r as_made copy
mkdir no_sums && printf '#!/bin/sh\nexit 1\n' >no_sums/sha256sum && chmod +x no_sums/sha256sum
exits 1 env PATH="$PWD/no_sums:$PATH" sh copy/verify.sh
exits 2 "$DOMEFALL" deliver fall.yaml --check copy
exits 2 "$DOMEFALL" deliver --check nowhere
says 'nowhere: there is no such folder'

# What does not fit is refused before anything is written.
refused() { # refused CODE PATTERN OPTION...
  local code=$1 pattern=$2
  shift 2
  exits "$code" deliver --out refused "$@"
  says "$pattern"
  [ ! -e refused ] || fail "something was written"
}
wav long_L.wav 2.5
printf '1\n00:00:00,500 --> 00:00:03,000\nToo long\n' >late.srt
refused 2 'long_L.wav: the sound lasts 2.500 s, and the show 2.000 s \(8 frames at 4 a second\)' --audio long_L.wav
refused 2 'late.srt: the last subtitle ends at 3.000 s' --subtitles late.srt
refused 2 'only letters' --name 'my show #####'
refused 2 'of another size, show or kind: 0-7' --size 32
printf x | dd of=made/graded/fall_00006.png bs=1 seek=900 conv=notrunc status=none
# What was delivered is the same file, and is found out.
exits 2 "$DOMEFALL" deliver --check as_made
says 'frames changed or damaged: 7$'
rm made/graded/fall_0000[1-3].png
refused 75 'damaged: 6'
refused 75 'missing: 1-3'
exits 0 "$DOMEFALL" render fall.yaml --out made
sed -i 's/output:/exposure: {ev: 1}\n&/' fall.yaml
refused 75 'of another version of the show.*: 0-7'
sed -i '/exposure/d' fall.yaml

# A folder that something else is in, or another delivery, stays as it is.
mkdir other && echo mine >other/README.txt
exits 2 deliver --out other
says 'other: the folder is not empty and holds no delivery'
[ "$(cat other/README.txt)" = mine ] || fail "a file was overwritten"
exits 2 deliver --out in_24_bits
says 'in_24_bits: 9 files are there not of this delivery, such as frames/my_show_000001_v2.png'
whole in_24_bits

# One that was broken off does not look whole, and the same command finishes it.
exits 0 deliver --out broken
rm broken/frames/fall_00004.png broken/checksums.sha256
echo >broken/INCOMPLETE.txt
exits 2 "$DOMEFALL" deliver --check broken
says 'it was not finished'
exits 1 sh broken/verify.sh
exits 0 deliver --out broken
whole broken
exits 0 deliver --out broken # again, over a whole one
whole broken
exits 0 deliver --out other_way
same_frames broken other_way

# A delivery that is ended in the middle, in whatever way, does not look whole either.
sed 's/second: 4/second: 60/; s/duration_s: 2/duration_s: 0.1/' fall.yaml >quick.yaml
exits 0 "$DOMEFALL" render quick.yaml --out quick
for signal in KILL TERM; do
  "$DOMEFALL" deliver quick.yaml --from quick --out ended --leader --threads 1 2>/dev/null &
  until [ -e ended/leader/quick_leader_00003.png ]; do sleep 0.01; done
  kill -s "$signal" $!
  ended $((128 + $(kill -l "$signal"))) $!
  exits 2 "$DOMEFALL" deliver --check ended
  says 'it was not finished'
  [ ! -e ended/verify.sh ] || fail "there is a script that has nothing to verify"
  exits 0 "$DOMEFALL" deliver quick.yaml --from quick --out ended --leader
  whole ended
  [ -z "$(find ended -name '.*')" ] || fail "left behind: $(find ended -name '.*')"
  rm -r ended
done

# A disk that is full is for later, and what is there does not look whole.
if (ulimit -f 0) 2>/dev/null; then
  (
    ulimit -f 8 # 4 or 8 KiB
    exits 75 deliver --out full --leader
  )
  if [ ! -e full/INCOMPLETE.txt ] || [ -e full/checksums.sha256 ]; then fail "it looks whole"; fi
  exits 0 deliver --out full --leader
  whole full
fi

# The contact sheet alone.
exits 0 "$DOMEFALL" sheet fall.yaml --from made --out sheet.png
exits 0 pngcheck -q sheet.png
exits 0 "$DOMEFALL" sheet fall.yaml --from made --frames 2-4 --out strip.png
wide_of() { identify -format %w "$1"; }
[ "$(wide_of strip.png)" -lt "$(wide_of sheet.png)" ] || fail "three frames take $(wide_of strip.png) columns"
exits 2 "$DOMEFALL" sheet fall.yaml --from made --frames 0-99 --out strip.png
rm made/graded/fall_00005.png
exits 75 "$DOMEFALL" sheet fall.yaml --from made --out again.png
says 'missing: 5$'
[ ! -e again.png ] || fail "a sheet was written"
