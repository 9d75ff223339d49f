#!/usr/bin/env bash
# domefall trace near a charge against the exact rays, every row of them: the right origin, the place on the
# sky, redshift, amplification, turns and Mino's time.
source "$(dirname "$0")/rays.bash"
rays=$DOMEFALL_SOURCE/tests/reference/charged_rays.csv
exits 0 "$DOMEFALL" trace --table "$rays"
right "$rays" spin,charge,r,delta,edge,offset,origin,beyond,turns \
  x=1e-10~ y=1e-10~ z=1e-10~ one_plus_z=1e-11 mino=1e-11 amplification=1e-7

columns=spin,charge,r,theta,delta,eta,edge,offset
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
says 'rays near a charge or a spinning hole are traced by the exact integral'
