#!/usr/bin/env bash
# domefall trace against the exact rays, every observer and row of them: the right sky, phi to 1e-10 by
# the table and to 1e-13 by the integral, redshift, slope and amplification.
source "$(dirname "$0")/rays.bash"
rays=$DOMEFALL_SOURCE/tests/reference/rays.csv places=$DOMEFALL_SOURCE/tests/reference/positions.csv
for method in table exact; do
  exits 0 "$DOMEFALL" trace --table "$rays" --method "$method"
  limit=1e-13
  [ "$method" = exact ] || limit=1e-10
  right "$rays" observer,r,delta,origin \
    phi=$limit~ one_plus_z=1e-7 slope=1e-7 amplification=1e-7
done

# Observers where they cannot be, edges that they do not see, delta beyond a half turn, numbers that are none.
columns=observer,r,delta,edge,offset
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
  right "$places" observer,r,delta r_there=1e-10
  ! grep -q ',$' stdout || fail "a place without its time"
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
