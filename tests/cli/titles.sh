#!/usr/bin/env bash
# Titles are in the files of the frames that show them, and in no other's key; what they need is
# loaded for such frames alone; check warns of what the machine cannot write.
source "$(dirname "$0")/common.bash"

# write_titled FILE TITLE...: eight frames, of which the first to the fourth have the titles.
write_titled() {
  cat >"$1" <<END
frames_per_second: 8
size: 64
sky: {region_I: {background: grid, stars: none}}
output: {graded: png8}
titles: [{duration_s: 0.5, height_deg: 12, $2}]
timeline: [{duration_s: 1}]
END
}
write_titled show.yaml 'text: Sgr A*'
exits 0 "$DOMEFALL" render show.yaml --out frames
exits 0 "$DOMEFALL" render show.yaml --out alone --frames 3 --threads 1
cmp frames/linear/show_00003.exr alone/linear/show_00003.exr || fail "a frame alone has other bytes"
sed '/^titles:/d' show.yaml >plain.yaml
exits 0 "$DOMEFALL" render plain.yaml --out plain --frames 3-4
same_pixels plain/linear/plain_00003.exr frames/linear/show_00003.exr && fail "no title is seen"
same_pixels plain/linear/plain_00004.exr frames/linear/show_00004.exr || fail "a title is seen after its time"

# Another text makes the frames with the title anew, and no other.
write_titled show.yaml 'text: Sgr B2'
exits 0 "$DOMEFALL" render show.yaml --out frames
says '^4 frames made, 4 already there'
exits 0 "$DOMEFALL" render show.yaml --out frames
says '^0 frames made, 8 already there'

exits 0 "$DOMEFALL" preview show.yaml --frame 0 --size 64x64 --out with.png
exits 0 "$DOMEFALL" preview plain.yaml --frame 0 --size 64x64 --out without.png
same_pixels with.png without.png && fail "the preview has no title"

write_titled strange.yaml "text: \"Vega \\U0010FF00\", font: Nobodys Grotesk, elevation_deg: -20"
exits 0 "$DOMEFALL" check strange.yaml
for pattern in "font 'Nobodys Grotesk', which this machine does not have" \
  'has 1 letter that no font of this machine has' 'has its middle outside the picture'; do
  tells "$pattern"
done
