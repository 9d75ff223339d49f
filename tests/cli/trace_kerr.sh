#!/usr/bin/env bash
# domefall trace near a spinning hole against the exact rays, every row of them, and their passages of the
# equatorial plane; and what it refuses.
source "$(dirname "$0")/rays.bash"
rays=$DOMEFALL_SOURCE/tests/reference/kerr_rays.csv
# The exact rows also follow light of the past horizon; those are checked for their origin only.
grep -v ',H,' "$rays" >skies.csv
exits 0 "$DOMEFALL" trace --table skies.csv
right skies.csv spin,charge,r,delta,edge,offset,origin,turns \
  x=1e-11~ y=1e-11~ z=1e-11~ one_plus_z=1e-14 mino=1e-14 amplification=1e-10
exits 0 "$DOMEFALL" trace --table "$rays"
right "$rays" spin,charge,r,delta,edge,offset,origin

passages=$DOMEFALL_SOURCE/tests/reference/kerr_disc.csv
exits 0 "$DOMEFALL" trace --table "$passages"
right "$passages" spin,charge,k,outgoing \
  r_there=1e-12 phi_there=1e-12~ null_time=1e-12~ shift_pro=1e-12 shift_retro=1e-12 flux_pro=1e-12~ flux_retro=1e-12~

columns=spin,charge,r,theta,delta,eta,edge,offset
refused '0.9,0.5,5,1,1,0,,' 'spin.2 . charge.2 must be at most 1'
refused '1.1,0,5,1,1,0,,' 'spin.2 . charge.2 must be at most 1'
# Nothing is said inside the inner horizon, but what is no ray is refused there, too.
refused '0.9,0.5,1,1,1,0,,' 'spin.2 . charge.2 must be at most 1'
refused '0.6,0,-3,4,1,0,,' 'theta must be from 0 to pi'
refused '0.6,0,0.1,4,1,0,,' 'theta must be from 0 to pi'
refused '0.6,0,0.1,1,4,0,,' 'delta must be from 0 to pi'
refused '0.6,0,0.1,1,,0,,' 'delta'
refused '0.6,0,0.1,1,,0,inner,0' 'edge must be silhouette, region3 or empty'
refused '0.5,0,5,4,1,0,,' 'theta must be from 0 to pi'
refused '0.5,0,5,1,4,0,,' 'delta must be from 0 to pi'
refused '0.5,0,5,1,,0,region3,0' 'there is no edge region3 at this r'
refused '0.5,0,5,1,,0,inner,0' 'edge must be silhouette, region3 or empty'
refused '0.5,0,5,1,,0,silhouette,-1' 'offset must keep delta from 0 to pi'
refused '0.5,0,5,1,1,0,,1e-3' 'offset is given without an edge'
refused '0.5,0,5,1,1,0,silhouette,1e-3' 'delta is 1, and edge and offset give'
columns=spin,charge,r,theta,delta,eta,k
refused '0.5,0,5,1,1,0,-1' 'k must be a whole number'
printf 'spin,r,theta,delta,eta\n0.5,5,1,1,0\n' >short.csv
exits 2 "$DOMEFALL" trace --table short.csv
grep -q 'no column charge' stderr || fail "a table without a charge is not told so"
