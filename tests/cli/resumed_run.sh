#!/usr/bin/env bash
# kill -9 in the middle of a run, then again: no frame lost, none damaged, none made twice.
source "$(dirname "$0")/common.bash"
write_show fall.yaml

exits 0 "$DOMEFALL" render fall.yaml --out whole
says '24 frames made, 0 already there'

# Frames of which both files are there.
pictures() {
  local frame
  for frame in broken/graded/*.png; do
    frame=${frame#broken/graded/}
    [ ! -e "broken/linear/${frame%.png}.exr" ] || echo "$frame"
  done | wc -l
}
for enough in 0 5 14; do
  rm -rf broken
  mkdir broken
  "$DOMEFALL" render fall.yaml --out broken 2>/dev/null &
  until [ "$(pictures)" -ge "$enough" ]; do sleep 0.01; done
  kill -9 $! 2>/dev/null || true
  wait $! 2>/dev/null || true
  there=$(pictures)
  # Nothing half-written bears a frame's name.
  while IFS= read -r file; do
    cmp -s "$file" "whole/${file#broken/}" || fail "$file is not the frame it says"
  done < <(find broken -name '*.exr' -o -name '*.png')
  exits 0 "$DOMEFALL" render fall.yaml --out broken
  says "$((24 - there)) frames made, $there already there"
  same_frames whole broken
done

# Done already: nothing is made, nothing is touched.
touch -d '2001-01-01' whole/linear/*.exr
exits 0 "$DOMEFALL" render fall.yaml --out whole
says '0 frames made, 24 already there'
[ -z "$(find whole/linear -newermt 2002-01-01 -name '*.exr')" ] || fail "a good frame was made again"

# Damage of every kind is mended, and only that.
truncate -s -100 broken/linear/fall_00003.exr
printf 'x' | dd of=broken/linear/fall_00007.exr bs=1 seek=3000 conv=notrunc status=none
truncate -s 200 broken/graded/fall_00011.png
rm broken/graded/fall_00013.png broken/linear/fall_00017.exr
exits 0 "$DOMEFALL" render fall.yaml --out broken
says '5 frames made, 19 already there'
same_frames whole broken

# Of a frame's two files, only the one that is missing is made.
rm broken/linear/fall_00005.exr broken/graded/fall_00006.png
touch -d '2001-01-01' broken/graded/fall_00005.png broken/linear/fall_00006.exr
exits 0 "$DOMEFALL" render fall.yaml --out broken
says '2 frames made, 22 already there'
for kept in graded/fall_00005.png linear/fall_00006.exr; do
  [ -z "$(find broken/$kept -newermt 2002-01-01)" ] || fail "$kept was made again"
done
same_frames whole broken

# A change of one segment makes its frames again, and not the other's.
sed -i 's/to_r: 1}/to_r: 0.9}/' fall.yaml
exits 0 "$DOMEFALL" render fall.yaml --out broken
says '11 frames made, 13 already there'

# A look-up table that a configuration reads is part of the grade.
cat >table.ocio <<'END'
ocio_profile_version: 2.1
search_path: .
roles: {default: ACEScg, scene_linear: ACEScg, color_timing: ACEScg}
displays:
  Wall: [!<View> {name: Wall, colorspace: Wall}]
colorspaces:
  - !<ColorSpace> {name: ACEScg}
  - !<ColorSpace> {name: Wall, from_scene_reference: !<FileTransform> {src: wall.cc}}
END
slope() { # slope S: the file that the configuration reads
  printf '<ColorCorrection id="wall"><SOPNode><Slope>%s %s %s</Slope><Offset>0 0 0</Offset>%s' \
    "$1" "$1" "$1" '<Power>1 1 1</Power></SOPNode></ColorCorrection>' >wall.cc
}
{
  cat fall.yaml
  echo 'grade: {config: table.ocio}'
} >wall.yaml
slope 0.1
exits 0 "$DOMEFALL" render wall.yaml --frames 0 --out wall
exits 0 "$DOMEFALL" render wall.yaml --frames 0 --out wall
says '^0 frames made'
slope 0.9
touch -d '2001-01-01' wall/linear/*.exr
exits 0 "$DOMEFALL" render wall.yaml --frames 0 --out wall
says '^1 frames made'
[ -z "$(find wall/linear -newermt 2002-01-01 -name '*.exr')" ] || fail "a new table rendered"

# A regrade renders nothing; it refuses frames of another version of the show.
sed -i '$a grade: {view: Star field}' fall.yaml
touch -d '2001-01-01' broken/linear/*.exr
exits 0 "$DOMEFALL" grade fall.yaml --out broken
says '24 frames made'
[ -z "$(find broken/linear -newermt 2002-01-01 -name '*.exr')" ] || fail "a regrade rendered"
cmp -s whole/graded/fall_00000.png broken/graded/fall_00000.png && fail "the grade had no effect"
sed -i '$a exposure: {ev: 1}' fall.yaml
exits 75 "$DOMEFALL" grade fall.yaml --out broken
says 'fall_00000.exr: 24 frames were not graded: 0-23\..*render them first'
