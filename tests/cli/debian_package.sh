#!/usr/bin/env bash
# CPack makes a Debian package of which lintian has nothing to say, whose program runs, and whose
# bytes do not depend on when it is made.
source "$(dirname "$0")/common.bash"
for program in cpack lintian dpkg-deb; do
  command -v "$program" >/dev/null || { echo "skipped: no $program"; exit 77; }
done
export LC_ALL=C.UTF-8  # Perl would tell of a locale that is not there
build=$(dirname "$DOMEFALL")

# The maps and the gallery, nine tenths of the bytes, are left out: packing them takes most of the time.
cat >small_tree.cmake <<END
include($DOMEFALL_SOURCE/pipeline/program/install/debian_tree.cmake)
file(GLOB maps \${root}/share/domefall/assets/*.sky \${root}/share/domefall/assets/*.exr)
file(REMOVE_RECURSE \${maps} \${doc}/docs/gallery)
END
# package FOLDER ARGUMENT...: makes it there, with these arguments of cpack.
package() {
  local out=$folder/$1
  shift
  cpack --config "$build/CPackConfig.cmake" -B "$out" -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip \
    -D CPACK_PRE_BUILD_SCRIPTS="$folder/small_tree.cmake" "$@" >"$out.log" 2>&1 ||
    fail "cpack: $(cat "$out.log")"
}
package whole
# To look the libraries' packages up takes most of what is left, and says nothing of the bytes.
{
  package first -D CPACK_DEBIAN_PACKAGE_SHLIBDEPS=OFF
  package again -D CPACK_DEBIAN_PACKAGE_SHLIBDEPS=OFF
  cmp first/domefall_*.deb again/domefall_*.deb
} &
lintian --allow-root whole/domefall_*.deb >lintian.txt 2>&1 || fail "lintian: $(cat lintian.txt)"
[ ! -s lintian.txt ] || fail "lintian says: $(cat lintian.txt)"
wait $! || fail "two packages of one build differ"

deb=$(echo whole/domefall_*.deb)
dpkg-deb -f "$deb" >control
grep -qE '^Depends:.* libc6 .*libopenimageio.*' control || fail "the libraries are not named: $(cat control)"
grep -qE '^Recommends:.*ffmpeg' control || fail "ffmpeg is not recommended"
dpkg-deb -x "$deb" root
write_grid_show show.yaml
exits 0 "$DOMEFALL" render show.yaml --frames 7 --out built
exits 0 env -i PATH=/usr/bin:/bin root/usr/bin/domefall render show.yaml --frames 7 --out packed
same_frames built packed
if [ -n "${DOMEFALL_PYTHON:-}" ]; then
  exits 0 env -i PATH=/usr/bin:/bin PYTHONPATH=root/usr/lib/python3/dist-packages \
    "$DOMEFALL_PYTHON" -c 'import domefall; assert domefall.Show("show.yaml").frames == 60'
  grep -qE '^Depends:.* python3 \(<< 3\.' control || fail "Python's version is not named: $(cat control)"
fi
zcat root/usr/share/man/man1/domefall-render.1.gz | grep -q '^\.TH ' || fail "no manual page"
zcat root/usr/share/doc/domefall/changelog.Debian.gz |
  grep -qF "domefall ($(sed -n 's/^Version: //p' control))" || fail "the changelog is of another version"

# Each file of others that THIRD_PARTY.md lists is in Debian's list of licences, too.
grep '^| .shows/assets/' "$DOMEFALL_SOURCE/THIRD_PARTY.md" | grep -oE '[a-z_0-9]+\.(stars|csv|exr)' |
  while read -r file; do
    grep -qE "(Files:)? shows/assets/$file\$" root/usr/share/doc/domefall/copyright ||
      fail "copyright does not name $file"
  done
