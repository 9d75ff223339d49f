#!/usr/bin/env bash
# A dome's own light: render, grade and preview add it or take it away, and only graded frames change.
source "$(dirname "$0")/common.bash"
write_show plain.yaml
sed 's/A short fall/A short fall in a dome/' plain.yaml >fall.yaml
{ cat fall.yaml; echo 'dome: {light: simulate}'; } >simulate.yaml
{ cat fall.yaml; echo 'dome: {light: compensate}'; } >compensate.yaml

# light IMAGE: the mean of its codes, of 2^40
light() { oiiotool "$1" --echo '{TOP.AVGCOLOR}' | awk -F, '{ printf "%.0f", 2 ^ 40 / 3 * ($1 + $2 + $3) }'; }
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
