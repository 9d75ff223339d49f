#!/usr/bin/env bash
# Processors of several generations pack a picture into the same bytes: the encoders of image files
# choose their instructions themselves, and DOMEFALL_SIMD says nothing to them.
source "$(dirname "$0")/common.bash"
tests=$(dirname "$DOMEFALL")/tests/test_image
[ -x "$tests" ] || { echo "skipped: test_image is not built"; exit 77; }
if nm -D "$tests" 2>/dev/null | grep -q __asan; then
  echo "skipped: qemu-user has no room for the shadow memory of the sanitizers"
  exit 77
fi
packed() { # packed COMMAND...: what the tests print of the bytes, run by COMMAND
  exits 0 "$@" "$tests" --gtest_filter='Deflate.PacksIntoTheSameBytesAgain:PictureWriters.PackIntoTheSameBytes*'
  grep '^packed bytes: ' "$folder/stdout"
}
packed env >"$folder/here"
[ "$(wc -l <"$folder/here")" -eq 2 ] || fail "the tests print: $(cat "$folder/here")"
for processor in Nehalem Haswell; do # SSE4.2; AVX2
  packed qemu-x86_64 -cpu "$processor" >"$folder/there"
  cmp "$folder/here" "$folder/there" || fail "$processor packs otherwise"
done
