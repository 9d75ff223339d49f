#!/usr/bin/env bash
# Other programs read every kind of file that a frame can be, and see the same pixels.
source "$(dirname "$0")/common.bash"
write_show show.yaml
sed 's/^timeline/output: {graded: tiff16}\n&/' show.yaml >tiff.yaml
exits 0 "$DOMEFALL" render show.yaml --frames 3 --size 200 --out out
exits 0 "$DOMEFALL" render tiff.yaml --frames 3 --size 200 --out out
exits 0 "$DOMEFALL" preview show.yaml --frame 3 --size 200x160 --out out/still.jpg
png=out/graded/show_00003.png tiff=out/graded/tiff_00003.tif exr=out/linear/show_00003.exr

exits 0 pngcheck -v "$png"
# The power of 2.2 that the default display has, and the profile that says the same.
grep -q 'chunk gAMA .*: 0\.45455' stdout || fail "the PNG does not say its gamma: $(cat stdout)"
grep -q 'White x = 0\.3127 y = 0\.329' stdout || fail "the PNG does not say its primaries"
! grep -q 'chunk sRGB' stdout || fail "the PNG says that it is sRGB"
exits 0 identify -regard-warnings -verbose "$png"
for file in "$tiff" out/still.jpg; do
  exits 0 identify -regard-warnings -verbose "$file"
  grep -q 'Profile-icc' stdout || fail "$file has no profile"
done
grep -q '1x1,1x1,1x1' stdout || fail "the JPEG's colours are coarser than its light"

# same_pixels PROGRAM: PNG and TIFF hold the same, as the program reads them.
same_pixels() {
  cmp png.rgb tiff.rgb >&2 || fail "$1 reads other pixels in the TIFF than in the PNG"
  [ "$(stat -c %s png.rgb)" -eq $((200 * 200 * 3 * 2)) ] || fail "$1 reads another size"
}
exits 0 convert "$png" -depth 16 -endian LSB rgb:png.rgb
exits 0 convert "$tiff" -depth 16 -endian LSB rgb:tiff.rgb
same_pixels ImageMagick
cp png.rgb imagemagick.rgb
raw=(-f rawvideo -pix_fmt rgb48le)
exits 0 ffmpeg -v error -xerror -i "$png" "${raw[@]}" -y png.rgb
exits 0 ffmpeg -v error -xerror -i "$tiff" "${raw[@]}" -y tiff.rgb
same_pixels ffmpeg
cmp png.rgb imagemagick.rgb >&2 || fail "ffmpeg and ImageMagick read other pixels"
exits 0 ffmpeg -v error -xerror -i out/still.jpg -f null -
exits 0 ffmpeg -v error -xerror -i "$exr" -f null -
[ ! -s stderr ] || fail "ffmpeg complains of the EXR: $(cat stderr)"

exits 0 oiiotool --hash "$exr" "$png" "$tiff" out/still.jpg
[ "$(grep -c 'SHA-1:' stdout)" -eq 4 ] || fail "OpenImageIO could not read a file"
exits 0 oiiotool "$png" "$tiff" --diff
