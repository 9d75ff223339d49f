#!/usr/bin/env bash
# A node with a lesser processor: its sines differ in the last bits, yet it knows this node's frames for
# good, and makes the same ones.
source "$(dirname "$0")/common.bash"
cat >orbit.yaml <<'END'
size: 64
black_hole: {mass_solar: 10}
camera: {look_at: Sirius}
timeline:
  - {duration_s: 20, trajectory: {type: circular, r: 6.3, orbits: 3}}
  - {duration_s: 10, trajectory: {type: infall, from_r: 6.3, to_r: 0.3, pace: slowing}}
END
tunables=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX512F
other=(env "GLIBC_TUNABLES=$tunables" DOMEFALL_SIMD=portable "$DOMEFALL")
exits 0 "$DOMEFALL" states orbit.yaml
cp stdout here.csv
exits 0 "${other[@]}" states orbit.yaml
if cmp -s here.csv stdout; then
  echo "skipped: this C library computes alike with and without FMA and AVX2"
  exit 77
fi
# The frames whose states differ.
frames=$({ diff here.csv stdout || true; } | sed -nE 's/^> ([0-9]+),.*/\1/p' | head -8 | paste -sd,)
exits 0 "$DOMEFALL" render orbit.yaml --frames "$frames" --out here
exits 0 "${other[@]}" render orbit.yaml --frames "$frames" --out here
says '^0 frames made'
exits 0 "${other[@]}" render orbit.yaml --frames "$frames" --out there
same_frames here there
