#!/usr/bin/env bash
# What is installed runs from wherever it is put, with nothing of the source tree or the build in
# reach, and makes the frames of the program in the build.  The launchers find it.
source "$(dirname "$0")/common.bash"
build=$(dirname "$DOMEFALL")

# Staged as packagers do, for a prefix that it then leaves.
DESTDIR=$folder/stage cmake --install "$build" --prefix /opt/shows >/dev/null
mv stage/opt/shows moved
[ -z "$(find stage ! -type d)" ] || fail "outside the prefix: $(find stage ! -type d | head -3)"
[ -z "$(find moved -xtype l)" ] || fail "links to nothing: $(find moved -xtype l)"

# alone COMMAND...: runs it in an empty environment, and where the system allows it with empty
# folders in the places of source tree and build.
if unshare --mount true 2>/dev/null; then
  alone() {
    # shellcheck disable=SC2016
    env -i PATH=/usr/bin:/bin unshare --mount bash -c 'for place in "$1" "$2"; do
        [ ! -d "$place" ] || mount -t tmpfs tmpfs "$place" || exit 99
      done; cd "$3" && shift 3 && exec "$@"' alone "$build" "$DOMEFALL_SOURCE" "$PWD" "$@"
  }
  exits 1 alone test -e "$DOMEFALL_SOURCE/shows/assets/dome.ocio"
else
  alone() { env -i PATH=/usr/bin:/bin "$@"; }
fi

# Maps, stars, colours, letters and places by name, and a catalogue beside the figures of the paper.
program=$folder/moved/bin/domefall
write_show show.yaml
sed -i 's/mass_solar: 4.3e6/&, at: Andromeda/' show.yaml
echo 'titles: [{text: Vega, at_s: 1}]' >>show.yaml
exits 0 "$DOMEFALL" render show.yaml --frames 3,14 --out built
exits 0 alone "$program" render show.yaml --frames 3,14 --out installed
same_frames built installed
# The farm's workers are the program that was installed, found by no PATH.
exits 0 alone "$program" farm submit show.yaml --engine local --frames 3-3 --out farmed --workers 1
exits 0 alone "$program" render show.yaml --frames 14 --out farmed
rm -r farmed/farm
same_frames built farmed

figure=moved/share/domefall/shows/paper/mult.yaml
exits 0 "$DOMEFALL" render "$DOMEFALL_SOURCE/shows/paper/mult.yaml" --frames 0 --size 64x64 --out built
exits 0 alone "$program" render "$figure" --frames 0 --size 64x64 --out installed
same_frames built installed

# Every show, document and asset that the text of the others names is there.
(cd "$DOMEFALL_SOURCE/shows" && find . -name '*.yaml' | sort) >wanted
(cd moved/share/domefall/shows && find . -name '*.yaml' | sort) >there
diff wanted there || fail "shows are missing"
for document in README.md LICENSE THIRD_PARTY.md docs/show-format.md docs/gallery/README.md; do
  [ -f "moved/share/doc/domefall/$document" ] || fail "no $document"
done
while read -r file; do
  [ -f "moved/share/domefall/assets/$file" ] || fail "THIRD_PARTY.md has $file, which is not there"
done < <(grep '^| .shows/assets/' "$DOMEFALL_SOURCE/THIRD_PARTY.md" | grep -oE '[a-z_0-9]+\.(stars|csv|exr)')

# A page for each verb, which troff reads without a warning.
for verb in $("$program" --help | sed -n '/^Subcommands/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
  page=moved/share/man/man1/domefall-$verb.1
  [ -s "$page" ] || fail "no manual page of $verb"
done
for page in moved/share/man/man1/*.1; do
  groff -ww -z -man -Tutf8 "$page" 2>warnings || true
  [ ! -s warnings ] || fail "$page: $(head -3 warnings)"
done
groff -man -Tascii -P-cbou moved/share/man/man1/domefall-movie.1 >page
grep -q -- '--preset {review,dome,dome8k,master,hap,vr360}' page || fail "the presets are not listed"
