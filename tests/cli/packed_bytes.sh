#!/usr/bin/env bash
# Processors of several generations pack a picture into the same bytes: the encoders of image files
# choose their instructions themselves, and DOMEFALL_SIMD says nothing to them.
# shellcheck source=tests/cli/common.bash
source "$(dirname "$0")/common.bash"
tests=$(dirname "$DOMEFALL")/tests/test_image
[ -x "$tests" ] || { echo "skipped: test_image is not built"; exit 77; }
if nm -D "$tests" 2>/dev/null | grep -q __asan; then
  echo "skipped: qemu-user has no room for the shadow memory of the sanitizers"
  exit 77
fi
exits 0 "$tests" --gtest_filter='*GivesTheBytesThatItGivesElsewhere'
grep -q '\[  PASSED  \] 2 tests' "$folder/stdout" || fail "no test was run"
for processor in Nehalem Haswell; do # SSE4.2; AVX2
  exits 0 qemu-x86_64 -cpu "$processor" "$tests" --gtest_filter='*GivesTheBytesThatItGivesElsewhere'
done
