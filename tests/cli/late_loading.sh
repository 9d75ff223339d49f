#!/usr/bin/env bash
# OpenImageIO and CFITSIO with their 260 libraries are loaded when an image is read or written, and
# not before; an installed program finds what calls them, and says so when it is missing.
# shellcheck source=tests/cli/common.bash
source "$(dirname "$0")/common.bash"
cd "$folder"

# loads COMMAND...: it ends well; true if the dynamic linker initialised one of the two.
loads() {
  rm -f linker.*
  exits 0 env LD_DEBUG=files LD_DEBUG_OUTPUT="$folder/linker" "$@"
  grep -q 'calling init: .*/libstdc++' linker.* || fail "the dynamic linker wrote nothing of use"
  grep -qE 'calling init: .*/lib(OpenImageIO|cfitsio)' linker.*
}

write_show show.yaml
sed 's/stars: naked_eye/background: grid, stars: none/' show.yaml >grid.yaml
sed 's/^timeline/output: {graded: none}\n&/' show.yaml >linear.yaml
for command in "--version" "render --help" "probe grid.yaml --pixel 40,50" "check show.yaml" \
  "render linear.yaml --frames 3 --out linear"; do
  # shellcheck disable=SC2086
  ! loads "$DOMEFALL" $command || fail "$command loads the libraries of images"
done
loads "$DOMEFALL" render show.yaml --frames 3 --out built ||
  fail "a PNG was written without OpenImageIO"

build=$(dirname "$DOMEFALL")
cmake --install "$build" --prefix "$folder/installed" >/dev/null
installed=$folder/installed/bin/domefall
exits 0 "$installed" render show.yaml --frames 3 --out installed_frames
same_frames built installed_frames

find installed -name 'libdomefall_image_formats.so' -delete
exits 75 "$installed" render show.yaml --frames 4 --out incomplete
says 'reads and writes images cannot be loaded: libdomefall_image_formats\.so: '
[ -z "$(find incomplete -name '*.png')" ] || fail "a PNG was written all the same"
exits 0 "$installed" render linear.yaml --frames 3 --out installed_linear
same_frames linear installed_linear
