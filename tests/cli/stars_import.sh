#!/usr/bin/env bash
# Star catalogues as a user makes, looks into and shows them.
source "$(dirname "$0")/common.bash"
rows=$DOMEFALL_SOURCE/tests/reference/stars

# Import: Tycho-2 repaired, named and corrected; talk on stderr, nothing on stdout.
cat >by_hand.csv <<END
star,action,v_mag,b_v,ra_deg,dec_deg
Vega,,0.1,,,
HIP 55203,remove,,,,
Nemesis,add,1,1.6,90,0
END
exits 0 "$DOMEFALL" stars import tycho2 "$rows/tyc2.dat" "$rows/suppl_1.dat" --hipparcos "$rows/stars.json" \
  --names "$rows/starnames.json" --corrections by_hand.csv --out few.stars
says '^Tycho-2 \(I/259\): 11 stars$'
says 'V of 4 stars, colour of 2 that had none, 3 stars added$'
says '^by_hand.csv: 3 corrections$'
says '^few.stars: 14 stars, V -1.44 to '
[ ! -s stdout ] || fail "talk on stdout"

# The same again is the same file.
cp few.stars first.stars
exits 0 "$DOMEFALL" stars import auto "$rows/tyc2.dat" "$rows/suppl_1.dat" --hipparcos "$rows/stars.json" \
  --names "$rows/starnames.json" --corrections by_hand.csv --out few.stars
says '^taken as Tycho-2'
cmp few.stars first.stars || fail "two imports differ"

exits 0 "$DOMEFALL" stars info few.stars
grep -q '^source  *Tycho-2' stdout || fail "no source"
grep -q '^V <= 0  *1$' stdout || fail "counts: $(cat stdout)"
exits 0 "$DOMEFALL" stars info few.stars --json
python3 - stdout <<'END' || fail "the JSON is not what it should be"
import json, sys
facts = json.load(open(sys.argv[1]))
assert facts["stars"] == 14 and facts["epoch"] == 2000 and facts["brightest_v"] == -1.44, facts
assert facts["counts"][-1]["stars"] == 14 and "BSD-2-Clause" in facts["licence"], facts
END

exits 0 "$DOMEFALL" stars import d3-celestial "$rows/stars.json" --faintest 5 --out bright.stars
says '^bright.stars: 5 stars'

# A show that uses it: its picture is not that of an empty sky, and moves with the epoch.
show() {
  cat <<END
title: Sirius from a catalogue of one's own
size: 64
camera: {look_at: Sirius, elevation_deg: 90}
sky:
  epoch: $1
  region_I: {background: black, stars: {catalogue: few.stars, max_magnitude: $2}}
output: {graded: none}
timeline: [{duration_s: 0.1}]
END
}
show 2000 5 >now.yaml
show 2000 -5 >empty.yaml
show 30000 5 >later.yaml
for name in now empty later; do
  exits 0 "$DOMEFALL" render "$name.yaml" --frames 0 --out "$name"
done
exr() { find "$1" -name '*.exr'; }
! cmp -s "$(exr now)" "$(exr empty)" || fail "no star is seen"
! cmp -s "$(exr now)" "$(exr later)" || fail "Sirius does not move"
exits 0 "$DOMEFALL" check now.yaml

# Tables as spreadsheets, databases and VizieR write them give the same stars.
cat >plain.csv <<END
ra_deg,dec_deg,v_mag,b_v,pm_ra_mas_yr,pm_dec_mas_yr
101.3,-16.7,-1.44,,,
279.2,38.8,0.03,0.5,,
END
exits 0 "$DOMEFALL" stars import csv plain.csv --out plain.stars
sed 's/,,,$/,null,NaN,NA/; 1a deg,deg,mag,mag,mas/yr,mas/yr\n------,------,----,----,---,---' plain.csv |
  sed 's/,/;/g; s/\./,/g' | tr '[:lower:]' '[:upper:]' | iconv -t UTF-16 | gzip >packed
exits 0 "$DOMEFALL" stars import auto packed --out other.stars
says '^taken as Domefall.s CSV$'
# They differ in the names of the tables and so in their texts; the records are the last bytes.
cmp -s <(tail -c 64 plain.stars) <(tail -c 64 other.stars) || fail "other stars"

# What is wrong is told with its place, and leaves no file.
refused() {
  local pattern=$1
  shift
  exits 2 "$DOMEFALL" stars import "$@" --out none.stars
  says "$pattern"
  [ -z "$(find . -name '*none.stars*')" ] || fail "a refused import left $(find . -name '*none.stars*')"
}
head -c 700 "$rows/stars.json" >cut.json
refused '^cut.json: byte 701: ' auto cut.json
: >empty.dat
for format in tycho2 ascc hd hyg d3-celestial csv; do
  refused '^empty.dat: the file is empty$' "$format" empty.dat
done
refused '^by_hand.csv: not known by how it begins; name the format: tycho2, ' auto by_hand.csv
refused '^format nasa: must be one of tycho2, ' nasa by_hand.csv
refused '^missing.dat: No such file' hd missing.dat
printf 'star,v_mag\nVega,0.1\nHIP 7,2\n' >nobody.csv
refused "^nobody.csv:3: the catalogue has no star 'HIP 7'" d3-celestial "$rows/stars.json" \
  --names "$rows/starnames.json" --corrections nobody.csv
refused 'no star is left' d3-celestial "$rows/stars.json" --faintest -20
exits 75 "$DOMEFALL" stars import d3-celestial "$rows/stars.json" --out nowhere/none.stars
says '^nowhere/none.stars: '

# Damaged and foreign catalogues.
{ head -c -9 few.stars && printf x && tail -c 8 few.stars; } >bad.stars
exits 2 "$DOMEFALL" stars info bad.stars
says '^bad.stars: byte [0-9]+: the block of stars that begins here is damaged'
exits 2 "$DOMEFALL" stars info by_hand.csv
says '^by_hand.csv: byte 0: this is no star catalogue'
sed 's/few.stars/bad.stars/' now.yaml >bad.yaml
exits 2 "$DOMEFALL" check bad.yaml
says 'bad.stars: byte '

# What is to be read is not written over.
cp by_hand.csv kept.csv
exits 2 "$DOMEFALL" stars import csv kept.csv --out ./kept.csv
says '^--out ./kept.csv: that is the file to be read; name another$'
cmp by_hand.csv kept.csv || fail "the input was written over"
