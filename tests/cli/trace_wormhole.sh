#!/usr/bin/env bash
# domefall trace in wormholes against the exact rays, every row of them: the right side, the azimuth, its slope
# and the amplification.
source "$(dirname "$0")/rays.bash"
rays=$DOMEFALL_SOURCE/tests/reference/wormhole_rays.csv
for method in table exact; do
  exits 0 "$DOMEFALL" trace --table "$rays" --method "$method"
  limit=1e-13
  [ "$method" = exact ] || limit=1e-10
  right "$rays" profile,rho,a,m,l,delta,edge,offset,origin,one_plus_z \
    azimuth=$limit slope=1e-7 amplification=1e-6
done

columns=profile,rho,a,m,l,delta,edge,offset
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
