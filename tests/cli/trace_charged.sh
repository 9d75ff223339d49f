#!/usr/bin/env bash
# domefall trace near a charge against the exact rays, every row of them: the right origin, the place on the
# sky, redshift, amplification, turns and Mino's time.
source "$(dirname "$0")/common.bash"
rays=$DOMEFALL_SOURCE/tests/reference/charged_rays.csv
exits 0 "$DOMEFALL" trace --table "$rays"
python3 - "$rays" stdout <<'END'
import csv, sys
def rows(path):
    return list(csv.DictReader(l for l in open(path) if not l.startswith('#')))
exact, seen = rows(sys.argv[1]), rows(sys.argv[2])
assert len(exact) == len(seen) > 350, (len(exact), len(seen))
worst = {}
for e, s in zip(exact, seen):
    assert all(e[k] == s[k] for k in ('spin', 'charge', 'r', 'delta', 'edge', 'offset', 'origin', 'beyond')), (e, s)
    for k, limit, relative in (('x', 1e-10, False), ('y', 1e-10, False), ('z', 1e-10, False), ('one_plus_z', 1e-11, True),
                               ('mino', 1e-11, True), ('amplification', 1e-7, True)):
        if not e[k]:
            assert not s[k] or k == 'one_plus_z', (k, e, s)
            continue
        error = abs(float(s[k]) - float(e[k])) / (abs(float(e[k])) if relative else 1)
        worst[k] = max(worst.get(k, 0), error)
        assert error < limit, (k, e, s)
    assert e['turns'] == s['turns'], (e, s)
print(len(exact), 'rays, worst errors', worst)
END

row() { printf 'spin,charge,r,theta,delta,eta,edge,offset\n%s\n' "$1" >row.csv; }
refused() { # refused ROW WORDS
  row "$1"
  exits 2 "$DOMEFALL" trace --table row.csv
  says "row.csv:2: $2"
}
refused '0.1,0.5,5,1,1,0,,' 'spin must be 0'
refused '0,-1,5,1,1,0,,' 'charge must be from 0 to 100'
refused '0,0.5,1e-6,1,1,0,,' 'r must be from 0.000133974596 to 1e12'
refused '0,1,1,1,1,0,,' 'r must not be that of the inner horizon'
refused '0,0.5,5,4,1,0,,' 'theta must be from 0 to pi'
refused '0,0.5,5,1,4,0,,' 'delta must be from 0 to pi'
refused '0,0.5,5,1,,0,region3,0' 'there is no edge region3 at this r'
refused '0,1.2,5,1,,0,silhouette,0' 'there is no edge silhouette at this r'
refused '0,0.5,5,1,,0,rim,0' 'edge must be silhouette, inner, region3 or empty'
refused '0,0.5,5,1,1,0,,1e-3' 'offset is given without an edge'
exits 2 "$DOMEFALL" trace --table "$rays" --method rk4
says 'rays near a charge are traced by the exact integral'
