#!/usr/bin/env bash
# OpenImageIO and CFITSIO with their 260 libraries are loaded when an image of another program is
# read, and not before: not for the frames that are written.  Pango is loaded when a text is drawn,
# libtiff when a TIFF file is written, Cairo and libcrypto for a delivery, and OpenSSL and Brotli when
# a preview is served.  An installed program finds what calls them, and says so when it is missing.
# shellcheck source=tests/cli/common.bash
source "$(dirname "$0")/common.bash"
cd "$folder"

late='OpenImageIO|cfitsio|pango|tiff|cairo|X11|crypto|ssl|brotli[a-z]*'
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
printf '%s\n' 'titles: [{text: Vega, at_s: 1}]' >>grid.yaml
! loads "$late" "$DOMEFALL" render grid.yaml --frames 3 --out untitled ||
  fail "a frame without titles loads Pango"
loads pango "$DOMEFALL" render grid.yaml --frames 12 --out titled ||
  fail "a title was drawn without Pango"
read=(sky import panorama.png --size 32 --out made.sky)
loads OpenImageIO "$DOMEFALL" "${read[@]}" || fail "a PNG was read without OpenImageIO"

cat >short.yaml <<'END'
size: 64
frames_per_second: 4
sky: {region_I: {background: grid, stars: none}}
output: {linear: none, graded: tiff8}
timeline: [{duration_s: 0.5}]
END
loads tiff "$DOMEFALL" render short.yaml --out short || fail "a TIFF file was written without libtiff"
! loads "${late/|tiff}" "$DOMEFALL" render short.yaml --out short_again ||
  fail "a TIFF file needs more than libtiff"
for library in cairo crypto; do
  loads $library "$DOMEFALL" deliver short.yaml --from short --out "by_$library" ||
    fail "a delivery was made without $library"
done

build=$(dirname "$DOMEFALL")
cmake --install "$build" --prefix "$folder/installed" >/dev/null
installed=$folder/installed/bin/domefall
exits 0 "$installed" render show.yaml --frames 3 --out installed_frames
same_frames built installed_frames
exits 0 "$installed" "${read[@]}"

# lacks LIBRARY WORK COMMAND...: without the library the command ends, and says what that does.
lacks() {
  find installed -name "libdomefall_$1.so" -delete
  exits 75 "$installed" "${@:3}"
  says "$2 cannot be loaded: libdomefall_$1\.so: "
}
lacks image_formats 'reads images' "${read[@]}"
exits 0 "$installed" render show.yaml --frames 4 --out without
[ -f without/graded/show_00004.png ] || fail "no frame was made without what reads images"
exits 0 "$installed" render grid.yaml --frames 12 --out with_text
lacks pango_lettering 'writes text' render grid.yaml --frames 12 --out without
lacks cairo_drawing 'draws contact sheets and leaders' deliver short.yaml --from short --out no_sheet
lacks libcrypto_sums 'makes checksums' deliver --check by_cairo
lacks libtiff_file 'writes TIFF files' render short.yaml --out no_tiff
lacks httplib_server 'serves the preview' preview short.yaml --no-open
exits 0 "$installed" render grid.yaml --frames 3 --out without
