#!/usr/bin/env bash
# domefall trace in wormholes against the exact rays, every row of them: the right side, the azimuth, its slope
# and the amplification.
source "$(dirname "$0")/common.bash"
rays=$DOMEFALL_SOURCE/tests/reference/wormhole_rays.csv
for method in table exact; do
  exits 0 "$DOMEFALL" trace --table "$rays" --method "$method"
  python3 - "$rays" stdout "$method" <<'END'
import csv, sys
def rows(path):
    return list(csv.DictReader(l for l in open(path) if not l.startswith('#')))
exact, seen = rows(sys.argv[1]), rows(sys.argv[2])
table = sys.argv[3] == 'table'
assert len(exact) == len(seen) > 150, (len(exact), len(seen))
worst = {}
for e, s in zip(exact, seen):
    assert all(e[k] == s[k] for k in ('profile', 'rho', 'a', 'm', 'l', 'delta', 'edge', 'offset', 'origin')), (e, s)
    assert s['one_plus_z'] == '1', s
    for k, limit in (('azimuth', 1e-10 if table else 1e-13), ('slope', 1e-7), ('amplification', 1e-6)):
        # After a million turns the sine of the azimuth has lost its digits.
        if k == 'amplification' and float(e['azimuth']) > 1e6:
            continue
        error = abs(float(s[k]) / float(e[k]) - 1)
        worst[k] = max(worst.get(k, 0), error)
        assert error < limit, (k, error, e, s)
print(sys.argv[3], len(exact), 'rays, worst errors', worst)
END
done

row() { printf 'profile,rho,a,m,l,delta,edge,offset\n%s\n' "$1" >row.csv; }
refused() { # refused ROW WORDS
  row "$1"
  exits 2 "$DOMEFALL" trace --table row.csv
  says "row.csv:2: $2"
}
refused 'morris,1,0,,5,1,,' 'profile must be ellis or dngr'
refused 'ellis,0,0,,5,1,,' 'rho must be above 0'
refused 'ellis,1,1,,5,1,,' 'the profile ellis has no cylinder'
refused 'dngr,1,1,,5,1,,' 'the profile dngr needs m'
refused 'dngr,1,-1,0.1,5,1,,' 'a over rho must be from 0 to'
refused 'dngr,1,1,0,5,1,,' 'm over rho must be from 1e-30 to'
refused 'ellis,1,,,x,1,,' "l must be a number, got 'x'"
refused 'ellis,1,,,5,4,,' 'delta must be from 0 to pi'
refused 'ellis,1,,,5,,rim,0.1' 'edge must be throat or empty'
refused 'ellis,1,,,5,,throat,-0.2' 'edge and offset must give an angle from 0 to pi'
refused 'ellis,1,,,5,1,throat,0.1' 'delta is 1, and edge and offset give 0.297'
refused 'ellis,1,,,5,1,,0.1' 'offset is given without an edge'
exits 2 "$DOMEFALL" trace --table "$rays" --method rk4
says 'rays in a wormhole are traced by table or exact'
# Light on the edge circles for ever, and on the axis it comes straight.
for method in table exact; do
  row 'ellis,1,,,5,,throat,0'
  exits 0 "$DOMEFALL" trace --table row.csv --method "$method"
  tells ',throat,0,,inf,inf,,0$'
  row 'ellis,1,,,1e6,3.14159265358979323846,,'
  exits 0 "$DOMEFALL" trace --table row.csv --method "$method"
  tells ',,,own,-?[0-9.e-]*,-1\.00000[0-9]*,1,0\.99999'
done
