#!/usr/bin/env bash
# domefall trace against the exact rays, every observer and row of them: the right sky, phi to 1e-10 by
# the table and to 1e-13 by the integral, redshift, slope and amplification.
# shellcheck source=tests/cli/common.bash
source "$(dirname "$0")/common.bash"
rays=$DOMEFALL_SOURCE/tests/reference/rays.csv
for method in table exact; do
  exits 0 "$DOMEFALL" trace --table "$rays" --method "$method"
  python3 - "$rays" "$folder/stdout" "$method" <<'END'
import csv, sys
def rows(path):
    return list(csv.DictReader(l for l in open(path) if not l.startswith('#')))
exact, seen = rows(sys.argv[1]), rows(sys.argv[2])
limit = 1e-10 if sys.argv[3] == 'table' else 1e-13
assert len(exact) == len(seen) > 700, (len(exact), len(seen))
worst = 0
for e, s in zip(exact, seen):
    assert all(e[k] == s[k] for k in ('observer', 'r', 'delta')), (e, s)
    assert e['origin'] == s['origin'], (e, s)
    phi = float(e['phi'])
    worst = max(worst, abs(float(s['phi']) - phi) / max(1, abs(phi)))
    assert bool(e['one_plus_z']) == bool(s['one_plus_z']), (e, s)
    for k in ('one_plus_z', 'slope', 'amplification'):
        if e[k]:
            assert abs(float(s[k]) / float(e[k]) - 1) < 1e-7, (k, e, s)
print(f'{sys.argv[3]}: {len(exact)} rays, worst error of phi {worst:.2g}')
assert worst < limit
END
done
printf 'observer,r,delta\nrain,zero,1\n' >"$folder/bad.csv"
exits 2 "$DOMEFALL" trace --table "$folder/bad.csv"
says "bad.csv:2: r must be a number, got 'zero'"

# Observers where they cannot be, edges that they do not see, delta beyond a half turn.
row() { printf 'observer,r,delta,edge,offset\n%s\n' "$1" >"$folder/bad.csv"; }
row 'T_II,2,1,,'
exits 2 "$DOMEFALL" trace --table "$folder/bad.csv"
says "bad.csv:2: r must be below 2 "
row 'T_IV,1,,silhouette,0.1'
exits 2 "$DOMEFALL" trace --table "$folder/bad.csv"
says "bad.csv:2: this observer sees no edge silhouette at this r"
row 'outgoing,5,3.2,,'
exits 2 "$DOMEFALL" trace --table "$folder/bad.csv"
says "bad.csv:2: delta must be from 0 to pi, got 3.2"
row 'rain,5,,silhouette,0'
exits 0 "$DOMEFALL" trace --table "$folder/bad.csv"
grep -q ',IV,inf,,inf,0$' "$folder/stdout" || fail "a ray on the edge circles for ever"
row 'outgoing,1,0,,'
exits 0 "$DOMEFALL" trace --table "$folder/bad.csv"
grep -q ',IV,0,,inf,0$' "$folder/stdout" || fail "a radial ray is not bent"

# r is taken from its decimals: next to the horizon a double of it would be a tenth off.
row 'static,2.000000000000001,,silhouette,1e-8'
exits 0 "$DOMEFALL" trace --table "$folder/bad.csv" --method exact
grep -q ',I,2.9084973755' "$folder/stdout" || fail "r = 2 + 1e-15 lost its distance from the horizon"

# Spreadsheets write a byte order mark, blanks and CRLF; other columns are left alone.
printf '\xEF\xBB\xBFnote, observer ,r,delta\r\n # a comment\r\nx, rain , 10 ,1\r\n' >"$folder/bad.csv"
exits 0 "$DOMEFALL" trace --table "$folder/bad.csv"
grep -q '^rain,10,1,,,I,' "$folder/stdout" || fail "a spreadsheet's table was not read"
row 'rain,10,1,,1e-3'
exits 2 "$DOMEFALL" trace --table "$folder/bad.csv"
says "bad.csv:2: offset is given without an edge"
row 'static,6,1,silhouette,0'
exits 2 "$DOMEFALL" trace --table "$folder/bad.csv"
says "bad.csv:2: delta is 1, and edge and offset give 0.785398"
row 'rain,0x10,1,,'
exits 2 "$DOMEFALL" trace --table "$folder/bad.csv"
says "bad.csv:2: r must be a number, got '0x10'"

# Places along rays: the 224 of the reference by what renders and by the closed form, one and its time by every
# integrator, and empty cells where a ray has ended or psi is not given.
for method in table exact; do
  exits 0 "$DOMEFALL" trace --table "$DOMEFALL_SOURCE/tests/reference/positions.csv" --method "$method"
  python3 - "$DOMEFALL_SOURCE/tests/reference/positions.csv" "$folder/stdout" <<'END'
import csv, sys
def rows(path):
    return list(csv.DictReader(l for l in open(path) if not l.startswith('#')))
exact, seen = rows(sys.argv[1]), rows(sys.argv[2])
assert len(exact) == len(seen) == 224
for e, s in zip(exact, seen):
    assert abs(float(s['r_there']) / float(e['r_there']) - 1) < 1e-10, (e, s)
    assert s['null_time'], s
END
done
printf 'observer,r,delta,psi\nrain,10,1,1\nrain,10,1,9\nrain,10,1,\nrain,10,0,1\nT_IV,1,1,0.1\n' >"$folder/psi.csv"
for method in rk4 dopri5 rkf78 binet-dopri5 binet-rkf78 exact table; do
  exits 0 "$DOMEFALL" trace --table "$folder/psi.csv" --method "$method"
  sed -n 2p "$folder/stdout" | cut -d, -f11 | grep -q '^13\.06725101[0-9]*$' || fail "$method: r_there"
  sed -n 2p "$folder/stdout" | cut -d, -f12 | grep -q '^-9\.08246619[0-9]*$' || fail "$method: null_time"
  for row in 3 4 5; do sed -n ${row}p "$folder/stdout" | grep -q ',,$' || fail "$method: row $row has a place"; done
  sed -n 6p "$folder/stdout" | cut -d, -f11 | grep -q '^0\.[0-9]*$' || fail "$method: r_there in region IV"
  sed -n 6p "$folder/stdout" | cut -d, -f12 | grep -q '^-0\.1538045894[0-9]*$' || fail "$method: null_time in region IV"
done
printf 'observer,r,delta,psi\nrain,10,1,-1\n' >"$folder/psi.csv"
exits 2 "$DOMEFALL" trace --table "$folder/psi.csv"
says "psi.csv:2: psi must be at least 0, got -1"
