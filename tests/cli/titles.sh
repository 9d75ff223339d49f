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

# Without its titles a show has the frames of one that has none, and subtitles all the same.
{ cat show.yaml; printf 'draw_titles: false\n'; } >bare.yaml
exits 0 "$DOMEFALL" render bare.yaml --out bare --frames 3
same_pixels plain/linear/plain_00003.exr bare/linear/bare_00003.exr || fail "draw_titles: false draws titles"
exits 0 "$DOMEFALL" timeline bare.yaml --format srt
tells '^Sgr B2$'
exits 0 "$DOMEFALL" render show.yaml --out without --frames 3 --overlay no_titles
same_pixels plain/linear/plain_00003.exr without/linear/show_00003.exr || fail "no_titles draws titles"
sed 's/^size: .*/size: 64\ncamera: {projection: cubemap}/' show.yaml >cube.yaml
exits 2 "$DOMEFALL" check cube.yaml
says 'titles cannot be drawn on a cubemap.*draw_titles: false'
sed 's/^size: .*/size: 64\ncamera: {projection: cubemap}/' bare.yaml >cube.yaml
exits 0 "$DOMEFALL" check cube.yaml

# A counter makes a frame another when its number changes, and a subtitle has its first value.
write_titled counted.yaml 'text: "{{{time}}}", shadow: 0.8, plate: 0.2'
sed -i 's/duration_s: 0.5/duration_s: 3/; s/duration_s: 1}/duration_s: 4}/' counted.yaml
exits 0 "$DOMEFALL" render counted.yaml --out counted
same_pixels counted/linear/counted_0000{0,7}.exr || fail "a counter changes within a second"
same_pixels counted/linear/counted_000{07,08}.exr && fail "a counter stands still"
exits 0 "$DOMEFALL" timeline counted.yaml --format vtt
tells '^\{0:00\}$'

exits 0 "$DOMEFALL" preview show.yaml --frame 0 --size 64x64 --out with.png
exits 0 "$DOMEFALL" preview plain.yaml --frame 0 --size 64x64 --out without.png
same_pixels with.png without.png && fail "the preview has no title"

write_titled strange.yaml "text: \"Vega \\U0010FF00\", font: Nobodys Grotesk, elevation_deg: -20"
exits 0 "$DOMEFALL" check strange.yaml
for pattern in "font 'Nobodys Grotesk', which this machine does not have" \
  'has 1 letter that no font of this machine has' 'has its middle outside the picture'; do
  tells "$pattern"
done
