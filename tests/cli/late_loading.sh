#!/usr/bin/env bash
# OpenImageIO and CFITSIO with their 260 libraries are loaded when an image of another program is
# read, and not before: not for the frames that are written.  An installed program finds what calls
# them, and says so when it is missing.
source "$(dirname "$0")/common.bash"

late='OpenImageIO|cfitsio'
# loads LIBRARIES COMMAND...: it ends well; true if the dynamic linker initialised one of them.
loads() {
  local libraries=$1
  shift
  rm -f linker.*
  exits 0 env LD_DEBUG=files LD_DEBUG_OUTPUT="$folder/linker" "$@"
  grep -q 'calling init: .*/libstdc++' linker.* || fail "the dynamic linker wrote nothing of use"
  grep -qE "calling init: .*/lib($libraries)[.0-9-]*\.so" linker.*
}

write_show show.yaml
sed 's/stars: naked_eye/background: grid, stars: none/' show.yaml >grid.yaml
for command in "--version" "render --help" "probe grid.yaml --pixel 40,50" "check show.yaml" \
  "render show.yaml --frames 3 --out built" "preview show.yaml --frame 3 --size 128x64 --out panorama.png"; do
  # shellcheck disable=SC2086
  ! loads "$late" "$DOMEFALL" $command || fail "$command loads libraries that it does not need"
done
read=(sky import panorama.png --size 32 --out made.sky)
loads OpenImageIO "$DOMEFALL" "${read[@]}" || fail "a PNG was read without OpenImageIO"

build=$(dirname "$DOMEFALL")
cmake --install "$build" --prefix "$folder/installed" >/dev/null
installed=$folder/installed/bin/domefall
exits 0 "$installed" render show.yaml --frames 3 --out installed_frames
same_frames built installed_frames
exits 0 "$installed" "${read[@]}"

find installed -name libdomefall_openimageio.so -delete
exits 75 "$installed" "${read[@]}"
says 'reads images cannot be loaded: libdomefall_openimageio\.so: '
exits 0 "$installed" render show.yaml --frames 4 --out without
[ -f without/graded/show_00004.png ] || fail "no frame was made without what reads images"
