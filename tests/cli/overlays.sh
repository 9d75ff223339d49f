#!/usr/bin/env bash
# Overlays are drawn where they are asked for, and frames with them are another show's: they do not
# take the place of finished ones, nor the other way round.
source "$(dirname "$0")/common.bash"

cat >show.yaml <<'END'
title: Plain
frames_per_second: 4
size: 96
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {background: grid, stars: naked_eye}}
output: {graded: png8}
timeline: [{duration_s: 1, trajectory: {type: infall, from_r: 6, to_r: 1}}]
END
all=grid,rim,safe_area,sweet_spot,silhouette,einstein_ring,star_names,burn_in
exits 0 "$DOMEFALL" render show.yaml --out plain
exits 0 "$DOMEFALL" render show.yaml --out drawn --overlay "$all"
for k in 0 1 2 3; do
  same_pixels plain/linear/show_0000$k.exr drawn/linear/show_0000$k.exr && fail "frame $k has no overlay"
done
exits 0 "$DOMEFALL" render show.yaml --out alone --frames 2 --threads 1 --overlay "$all"
cmp drawn/linear/show_00002.exr alone/linear/show_00002.exr ||
  fail "a frame alone has other bytes: $(oiiotool {drawn,alone}/linear/show_00002.exr --diff 2>&1)"

# Neither replaces the other unasked, and each is found again.
exits 2 "$DOMEFALL" render show.yaml --out plain --overlay rim
says 'Plain \(overlay rim\)'
exits 2 "$DOMEFALL" render show.yaml --out drawn
exits 0 "$DOMEFALL" render show.yaml --out drawn --overlay "$all"
says '^0 frames made, 4 already there'
exits 0 "$DOMEFALL" render show.yaml --out plain
says '^0 frames made, 4 already there'
exits 0 "$DOMEFALL" grade show.yaml --out drawn --overlay "$all"
says '^0 frames made, 4 already there'

exits 0 "$DOMEFALL" preview show.yaml --frame 1 --size 64x48 --out plain.png
exits 0 "$DOMEFALL" preview show.yaml --frame 1 --size 64x48 --overlay rim --out rim.png
same_pixels plain.png rim.png && fail "the preview has no overlay"
exits 0 "$DOMEFALL" movie show.yaml --preset review --overlay rim --out rim.mp4
exits 0 "$DOMEFALL" movie show.yaml --preset hap --from drawn --overlay "$all" --out drawn.mov

# About a spin, too, from outside the ergosphere and in it.
cat >spin.yaml <<'END'
title: Spin
frames_per_second: 4
size: 96
black_hole: {mass_solar: 4.3e6, spin: 0.9}
sky: {region_I: {background: black, stars: {gain: 0}}}
timeline: [{duration_s: 1, trajectory: {type: infall, from_r: 5, to_r: 1.5}}]
END
exits 0 "$DOMEFALL" preview spin.yaml --frame 0 --size 64x48 --out bare.png
for overlay in silhouette einstein_ring ergosphere; do
  exits 0 "$DOMEFALL" preview spin.yaml --frame 0 --size 64x48 --overlay $overlay --out curve.png
  same_pixels bare.png curve.png && fail "no $overlay about a spin"
done
exits 0 "$DOMEFALL" preview spin.yaml --frame 3 --size 64x48 --out bare.png
exits 0 "$DOMEFALL" preview spin.yaml --frame 3 --size 64x48 --overlay ergosphere --out words.png
same_pixels bare.png words.png && fail "nothing says that the observer is in the ergosphere"
exits 2 "$DOMEFALL" render show.yaml --overlay rim,ergosphere
says '^--overlay rim,ergosphere: only a hole that spins has an ergosphere'

exits 2 "$DOMEFALL" render show.yaml --overlay ''
says "^argument 4, after '--overlay', is empty"
exits 2 "$DOMEFALL" render show.yaml --overlay ,
says '^--overlay ,: overlays are grid, '
exits 2 "$DOMEFALL" render show.yaml --overlay rim,einstien_ring
says '^--overlay rim,einstien_ring: overlays are grid, .* did you mean einstein_ring'
