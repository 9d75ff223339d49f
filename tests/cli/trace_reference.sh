#!/usr/bin/env bash
# domefall trace against the exact rays, every observer and row of them: the right sky, phi to 1e-10 by
# the table and to 1e-13 by the integral, redshift, slope and amplification.
source "$(dirname "$0")/common.bash"
rays=$DOMEFALL_SOURCE/tests/reference/rays.csv places=$DOMEFALL_SOURCE/tests/reference/positions.csv
for method in table exact; do
  exits 0 "$DOMEFALL" trace --table "$rays" --method "$method"
  python3 - "$rays" stdout "$method" <<'END'
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

# Observers where they cannot be, edges that they do not see, delta beyond a half turn, numbers that are none.
row() { printf 'observer,r,delta,edge,offset\n%s\n' "$1" >row.csv; }
refused() { # refused ROW WORDS
  row "$1"
  exits 2 "$DOMEFALL" trace --table row.csv
  says "row.csv:2: $2"
}
refused 'T_II,2,1,,' 'r must be below 2 '
refused 'T_IV,1,,silhouette,0.1' 'this observer sees no edge silhouette at this r'
refused 'outgoing,5,3.2,,' 'delta must be from 0 to pi, got 3.2'
refused 'rain,10,1,,1e-3' 'offset is given without an edge'
refused 'static,6,1,silhouette,0' 'delta is 1, and edge and offset give 0.785398'
refused 'rain,0x10,1,,' "r must be a number, got '0x10'"
# A ray on the edge circles for ever, and a radial one is not bent.  r is taken from its decimals: next
# to the horizon a double of it would be a tenth off.
while IFS='|' read -r method ray found; do
  row "$ray"
  exits 0 "$DOMEFALL" trace --table row.csv ${method:+--method "$method"}
  tells "$found"
done <<'END'
|rain,5,,silhouette,0|,IV,inf,,inf,0$
|outgoing,1,0,,|,IV,0,,inf,0$
exact|static,2.000000000000001,,silhouette,1e-8|,I,2\.9084973755
END

# Places along rays: the 224 of the reference by what renders and by the closed form, one and its time by every
# integrator, and empty cells where a ray has ended or psi is not given.
for method in table exact; do
  exits 0 "$DOMEFALL" trace --table "$places" --method "$method"
  python3 - "$places" stdout <<'END'
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
printf 'observer,r,delta,psi\nrain,10,1,1\nrain,10,1,9\nrain,10,1,\nrain,10,0,1\nT_IV,1,1,0.1\n' >psi.csv
for method in rk4 dopri5 rkf78 binet-dopri5 binet-rkf78 exact table; do
  exits 0 "$DOMEFALL" trace --table psi.csv --method "$method"
  cut -d, -f11-12 stdout >places
  paste -sd' ' places | grep -qE '^r_there,null_time 13\.06725101[0-9]*,-9\.08246619[0-9]* , , , 0\.[0-9]*,-0\.1538045894[0-9]*$' ||
    fail "$method: $(cat places)"
done
printf 'observer,r,delta,psi\nrain,10,1,-1\n' >psi.csv
exits 2 "$DOMEFALL" trace --table psi.csv
says "psi.csv:2: psi must be at least 0, got -1"
