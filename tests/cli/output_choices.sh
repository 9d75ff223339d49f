#!/usr/bin/env bash
# What a show's `output` says of its files: which there are, what they are called, and that each kind
# is resumed and verified alike.
source "$(dirname "$0")/common.bash"
write_output() { # write_output FILE OUTPUT [LINE...]: 4 small frames
  cat >"$1" <<END
frames_per_second: 4
size: 64
sky: {region_I: {background: grid, stars: none}}
output: {$2}
timeline: [{duration_s: 1}]
END
  printf '%s\n' "${@:3}" >>"$1"
}
files() { (cd "$1" && find . -type f ! -name '*.json' | sort | paste -sd' '); }
has() { [ "$(files "$1")" = "$2" ] || fail "$1 holds $(files "$1")"; }

# Each kind alone: made, known for good, known for damaged, and made again with the same bytes.
for kind in png16:png png8:png jpeg:jpg tiff16:tif tiff8:tif; do
  write_output a.yaml "linear: none, graded: ${kind%:*}"
  file=graded/a_00001.${kind#*:}
  exits 0 "$DOMEFALL" render a.yaml --frames 0-1 --threads 1 --out "${kind%:*}"
  has "${kind%:*}" "./graded/a_00000.${kind#*:} ./$file"
  exits 0 "$DOMEFALL" render a.yaml --frames 0-1 --threads 4 --out four
  same_frames "${kind%:*}" four
  truncate -s -1 "four/$file"
  exits 0 "$DOMEFALL" render a.yaml --frames 0-1 --out four
  says '^1 frames made, 1 already there'
  same_frames "${kind%:*}" four
  rm -r four
done
write_output a.yaml "linear: none, graded: jpeg, quality: 60"
exits 0 "$DOMEFALL" render a.yaml --frames 0-1 --out jpeg
says '^2 frames made'
write_output a.yaml "linear: none, graded: png8"
exits 0 "$DOMEFALL" render a.yaml --frames 0-1 --out png16
says '^2 frames made' # 8 bits are no 16, though the name is the same
same_frames png8 png16

# There is nothing to be graded again, and grade says why.
exits 2 "$DOMEFALL" grade a.yaml --out png8
says 'a_00002.exr: 2 frames were not graded: 2-3\. .*linear: none'

# The compressions hold the same pixels.
for compression in zip zips piz none; do
  write_output b.yaml "graded: none, compression: $compression"
  exits 0 "$DOMEFALL" render b.yaml --frames 0 --out "$compression"
  exits 0 oiiotool --info -v "$compression/linear/b_00000.exr"
  grep -q "compression: \"$compression\"" stdout || fail "not $compression: $(cat stdout)"
  exits 0 oiiotool "$compression/linear/b_00000.exr" zip/linear/b_00000.exr --diff
done

# Floats hold what halves round, and are graded to the same codes, at once or later.
write_output f.yaml 'linear: float, owner: "A planetarium: us"'
write_output h.yaml "linear: half, name: f"
sed -i 's/^sky:.*/sky: {region_I: {background: black, stars: naked_eye}}/' f.yaml h.yaml
exits 0 "$DOMEFALL" render h.yaml --frames 0-1 --out halves
exits 0 "$DOMEFALL" render f.yaml --frames 0-1 --out floats
exits 0 oiiotool --info -v floats/linear/f_00001.exr
grep -q "3 channel, float openexr" stdout || fail "no floats: $(cat stdout)"
# OpenImageIO's name for the attribute is another one.
grep -q 'Copyright: "A planetarium: us"' stdout || fail "no owner: $(cat stdout)"
exits 0 oiiotool floats/linear/f_00001.exr -d half -o floats/rounded.exr
exits 0 oiiotool floats/rounded.exr halves/linear/f_00001.exr --diff
for number in 0 1; do
  exits 0 oiiotool {floats,halves}/graded/f_0000$number.png --diff
done
cp -r floats graded_later && rm graded_later/graded/*
exits 0 "$DOMEFALL" grade f.yaml --frames 0-1 --out graded_later
same_frames floats graded_later
exits 0 "$DOMEFALL" render f.yaml --frames 0-1 --out floats
says '^0 frames made, 2 already there'
sed -i 's/linear: float/linear: half/' f.yaml
exits 0 "$DOMEFALL" render f.yaml --frames 0-1 --out floats
says '^2 frames made, 0 already there'

# Names, numbers and folders; a resumed run finds the frames, and grade does.
write_output c.yaml "graded: png8, name: My Show 4K, start: 1001, digits: 6, per_folder: 3"
exits 0 "$DOMEFALL" render c.yaml --frames 1-2 --out named
one=My\ Show\ 4K_001001-001003 two=My\ Show\ 4K_001004-001006
has named "./graded/$one/My Show 4K_001002.png ./graded/$one/My Show 4K_001003.png $(
  )./linear/$one/My Show 4K_001002.exr ./linear/$one/My Show 4K_001003.exr"
exits 0 "$DOMEFALL" render c.yaml --out named
says '^2 frames made, 2 already there'
[ -f "named/linear/$two/My Show 4K_001004.exr" ] || fail "the second folder was not begun"
touch "named/graded/My Show 4K_001002.png" "named/graded/$one/stray.txt"
printf 'grade: {cdl: {slope: 0.9}}\n' >>c.yaml
exits 0 "$DOMEFALL" grade c.yaml --frames 3 --out named
says 'named: 2 files are not this show.s, and are left alone: graded/My Show 4K_001001-001003/stray.txt and graded/My'
says '^1 frames made'

# grade does what is there, and says what is not.
rm "named/linear/$one/My Show 4K_001003.exr"
exits 75 "$DOMEFALL" grade c.yaml --out named
says '^2 frames made, 1 already there'
says 'My Show 4K_001003.exr: 1 frame was not graded: 2\. .*; render them first'

# The farm knows the names.
exits 1 "$DOMEFALL" farm verify named --show c.yaml --json
python3 -c 'import json, sys; found = json.load(sys.stdin); assert found["missing"] == "2", found' <stdout
