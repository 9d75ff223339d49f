#!/usr/bin/env bash
# Segments and keyframes with CDLs of their own: only the frames whose CDL changes are graded again.
source "$(dirname "$0")/common.bash"
write_show() { # write_show SLOPE SATURATION: of the second segment, and at the end of the third
  cat >show.yaml <<END2
frames_per_second: 4
size: 64
timeline:
  - {duration_s: 1}
  - {duration_s: 1, grade: {cdl: {slope: $1}}}
  - {duration_s: 2, keyframes: [{at_s: 1.5, ease: linear, grade: {cdl: {saturation: $2}}}]}
END2
}
write_show 1 1
exits 0 "$DOMEFALL" render show.yaml --out out
says '^16 frames made'
cp -r out plain
write_show 1.1 1
touch -d '2001-01-01' out/linear/*.exr
exits 0 "$DOMEFALL" render show.yaml --out out
says 'segment 2: 4 frames will be graded again'
says '^4 frames made, 12 already there'
write_show 1.1 0
exits 0 "$DOMEFALL" render show.yaml --out out
says 'segment 3: 7 frames will be graded again'
says '^7 frames made, 9 already there'
[ -z "$(find out/linear -newermt 2002-01-01 -name '*.exr')" ] || fail "a new CDL rendered"
for frame in 00000 00003 00008; do
  cmp -s {plain,out}/graded/show_$frame.png || fail "frame $frame has no CDL and another grade"
done
for frame in 00004 00007 00010 00015; do
  cmp -s {plain,out}/graded/show_$frame.png && fail "frame $frame has the grade of before"
done

# The same frames from the start, and a preview, have the same grades.
exits 0 "$DOMEFALL" render show.yaml --out again
same_frames out again
exits 0 "$DOMEFALL" preview show.yaml --frame 15 --size 64x36 --out grey.png
write_show 1.1 1
exits 0 "$DOMEFALL" preview show.yaml --frame 15 --size 64x36 --out coloured.png
cmp -s grey.png coloured.png && fail "a preview does not follow the keyframes"
exits 0 "$DOMEFALL" check show.yaml
