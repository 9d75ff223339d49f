#!/usr/bin/env bash
# domefall states --plot: a page that XML readers accept, with three panels near a hole; the CSV beside it is
# the same as without; a folder that is not there is told before anything is printed.
source "$(dirname "$0")/common.bash"
write_show fall.yaml
sed 's/^title: .*/title: "R\&D: <a fall> 100 %"/' fall.yaml >odd_title.yaml

# panels FILE ID...: the page has these panels and no others, each of them with curves within the page.
panels() {
  python3 - "$@" <<'END'
import re, sys
import xml.etree.ElementTree as xml
svg = '{http://www.w3.org/2000/svg}'
root = xml.parse(sys.argv[1]).getroot()
assert root.tag == svg + 'svg', root.tag
width, height = float(root.get('width')), float(root.get('height'))
groups = {group.get('id'): group for group in root.iter(svg + 'g')}
assert sorted(groups) == sorted(sys.argv[2:]), sorted(groups)
for name, group in groups.items():
    curves = [path.get('d') for path in group.iter(svg + 'path')]
    assert max(d.count('L') for d in curves) >= 1, name
    for d in curves:
        numbers = [float(n) for n in re.findall(r'-?[\d.]+', d)]
        assert all(0 <= x <= width for x in numbers[::2]), (name, d[:80])
        assert all(0 <= y <= height for y in numbers[1::2]), (name, d[:80])
    assert any(text.text for text in group.iter(svg + 'text')), name
END
}

exits 0 "$DOMEFALL" states fall.yaml
mv stdout plain.csv
exits 0 "$DOMEFALL" states fall.yaml --plot fall.svg
cmp plain.csv stdout || fail "the CSV is another with --plot"
[[ $(grep -v -m1 '^#' plain.csv) == *,null_time,universe,l,latitude_deg ]] ||
  fail "no columns null_time, universe, l and latitude_deg"
panels fall.svg radius orbit penrose
grep -q '>A short fall<' fall.svg || fail "no title"
exits 0 "$DOMEFALL" states "$DOMEFALL_SOURCE/shows/last_stable_orbit.yaml" --frames 0 --plot orbit.svg
panels orbit.svg radius orbit penrose
exits 0 "$DOMEFALL" states odd_title.yaml --plot odd.svg
panels odd.svg radius orbit penrose
printf 'timeline: [{duration_s: 2}]\n' >flat.yaml
exits 0 "$DOMEFALL" states flat.yaml --plot flat.svg
panels flat.svg speed
grep -q 'flat space: no hole' flat.svg || fail "flat space is not explained"

# The same show gives the same page; the old one is replaced.
cp fall.svg first.svg
exits 0 "$DOMEFALL" states fall.yaml --frames 0 --plot fall.svg
cmp first.svg fall.svg || fail "two pages of one show differ"

exits 75 "$DOMEFALL" states fall.yaml --plot none/fall.svg
says '^none'
[ ! -s stdout ] || fail "talk on stdout"
mkdir taken.svg
exits 2 "$DOMEFALL" states fall.yaml --plot taken.svg
[ -z "$(find . -name '*.tmp')" ] || fail "temporaries were left"
