#!/usr/bin/env bash
# A sky that is changed while a run reads it leaves no wrong frame, whenever it is put back.
source "$(dirname "$0")/common.bash"
milky_way=$DOMEFALL_SOURCE/shows/assets/milky_way.exr
oiiotool "$milky_way" --resize:filter=box 256x128 -o day.exr
oiiotool day.exr --flop -o night.exr
for sky in day night; do
  "$DOMEFALL" sky import $sky.exr --size 64 --out $sky.sky 2>/dev/null
done
show() { # show SKY: 40 frames that look all around it
  cat >fall.yaml <<END
title: A turn
frames_per_second: 20
size: 160
sky: {region_I: {background: ./$1, stars: none}}
timeline: [{duration_s: 2, trajectory: {type: static}, camera: {look_at: {ra_deg: 266, dec_deg: -29}}}]
END
}
frames() { find "$1/linear" -name '*.exr' 2>/dev/null | wc -l; }
# until_made FOLDER COUNT: waits for so many frames, or for the end of the run.
until_made() { until [ "$(frames "$1")" -ge "$2" ] || ! kill -0 "$run" 2>/dev/null; do sleep 0.01; done; }

# In the place of the file, which a .sky file's pages are read from while frames are rendered, and by
# another file of its name.
overwrite() { dd if="$1" of="$2" conv=notrunc status=none; }
replace() { cp "$1" new && mv new "$2"; }
for case in "overwrite sky" "replace sky" "replace exr"; do
  read -r change kind <<<"$case"
  cp "day.$kind" "shown.$kind"
  show "shown.$kind"
  rm -rf whole run
  exits 0 "$DOMEFALL" render fall.yaml --out whole
  "$DOMEFALL" render fall.yaml --out run 2>run.log &
  run=$!
  until_made run 2
  $change "night.$kind" "shown.$kind"
  until_made run 10
  code=0
  wait "$run" || code=$?
  $change "day.$kind" "shown.$kind"
  [ "$code" -eq 75 ] || fail "$case: exit code $code"
  grep -q "/shown.$kind: the file was changed while the run was reading it; run again$" run.log ||
    fail "$case: $(cat run.log)"
  exits 0 "$DOMEFALL" render fall.yaml --out run
  same_frames whole run

  # Touched, but the same: the run reads it again and goes on.
  rm -rf run
  "$DOMEFALL" render fall.yaml --out run 2>run.log &
  run=$!
  until_made run 2
  touch "shown.$kind"
  wait "$run" || fail "$case: a touched file ended the run: $(cat run.log)"
  same_frames whole run
done
