#!/usr/bin/env bash
# domefall trace against the exact rays: the right sky on every row, phi to 1e-8 by the table and to
# 1e-12 by the integral for rows at least 1e-6 from an edge.
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
limit = 1e-8 if sys.argv[3] == 'table' else 1e-12
assert len(exact) == len(seen) > 700, (len(exact), len(seen))
worst = checked = 0
for e, s in zip(exact, seen):
    if e['observer'] not in ('rain', 'static'):
        continue
    assert all(e[k] == s[k] for k in ('observer', 'r', 'delta')), (e, s)
    assert e['origin'] == s['origin'], (e, s)
    if e['origin'] == 'IV' or (e['offset'] and abs(float(e['offset'])) < 1e-6):
        continue
    phi = float(e['phi'])
    worst = max(worst, abs(float(s['phi']) - phi) / max(1, abs(phi)))
    checked += 1
print(f'{sys.argv[3]}: {checked} rays, worst error of phi {worst:.2g}')
assert checked > 250 and worst < limit
END
done
printf 'observer,r,delta\nrain,zero,1\n' >"$folder/bad.csv"
exits 2 "$DOMEFALL" trace --table "$folder/bad.csv"
says "bad.csv:2: r must be a number, got 'zero'"
