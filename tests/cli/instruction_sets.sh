#!/usr/bin/env bash
# DOMEFALL_SIMD has the loops run as on a lesser processor: the same files, to the last byte.  What it
# cannot mean is told before anything is made.
source "$(dirname "$0")/common.bash"
cat >skies.yaml <<'END'
size: 192
black_hole: {mass_solar: 10}
timeline:
  - {duration_s: 1, trajectory: {type: infall, from_r: 7, to_r: 0.2}}
END
render() { "$DOMEFALL" render skies.yaml --frames 0-29x7 --explain "$@"; }

export DOMEFALL_SIMD=portable
exits 0 render --out portable
says 'loops: portable$'
widest=portable
for level in avx2 avx512; do
  DOMEFALL_SIMD=$level code=0
  render --out $level >stdout 2>stderr || code=$?
  if [ "$code" -eq 2 ]; then
    says "^DOMEFALL_SIMD: this processor has no $level\$"
    [ ! -e $level ] || fail "a level that is not there left a folder"
    continue
  fi
  [ "$code" -eq 0 ] || { cat stderr >&2; fail "exit code $code with $level"; }
  says "loops: $level\$"
  same_frames portable $level
  echo "$level: the same files as portable"
  widest=$level
done

for word in avx1024 AVX2 'avx2 ' auto; do
  DOMEFALL_SIMD=$word
  exits 2 render --out none
  says "^DOMEFALL_SIMD is portable, avx2 or avx512, not '$word'\$"
  [ ! -e none ] || fail "a nonsense level left a folder"
done

# Without a word the widest there is; and it takes the others' frames for its own.
DOMEFALL_SIMD=
exits 0 render --out best
says "loops: $widest\$"
unset DOMEFALL_SIMD
exits 0 render --out portable
says '^0 frames made'
