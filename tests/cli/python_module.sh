#!/usr/bin/env bash
# The Python module gives the numbers of the program: states, rays, frames and graded frames, bit
# for bit, in the build tree and installed.  It loads little, its errors are Python's, and Ctrl-C
# ends its work.
source "$(dirname "$0")/common.bash"
[ -n "${DOMEFALL_PYTHON:-}" ] || exit 77  # built without the module
"$DOMEFALL_PYTHON" -c 'import numpy' || exit 77
build=$(dirname "$DOMEFALL")
export PYTHONDONTWRITEBYTECODE=1
python() { exits 0 env PYTHONPATH="$build/python" "$DOMEFALL_PYTHON" "$@"; }

# A dome that falls through the horizon, and a flat picture with an open shutter and a dissolve.
write_show dome.yaml
printf '%s\n' 'output: {linear: float, compression: none}' >>dome.yaml
cat >flat.yaml <<'END'
title: Ein flaches Bild – 平
frames_per_second: 10
size: [80, 48]
camera: {projection: stereographic}
output: {compression: none}
black_hole: {mass_solar: 10}
timeline:
  - {duration_s: 1, trajectory: {type: circular, r: 8, orbits: 0.02}}
  - {duration_s: 1, dissolve_s: 0.5, trajectory: {type: infall, from_r: 5, to_r: 3}}
exposure: {shutter_deg: 180}
END
exits 0 "$DOMEFALL" render dome.yaml --frames 3,20 --out dome
exits 0 "$DOMEFALL" render dome.yaml --frames 20 --size 130 --out larger
exits 0 "$DOMEFALL" render flat.yaml --frames 7,12 --out flat
for frame in dome/graded/dome_000{03,20} larger/graded/dome_00020 flat/graded/flat_000{07,12}; do
  convert "$frame.png" -depth 16 -endian LSB "rgb:$frame.raw"
done
for show in dome flat; do
  exits 0 "$DOMEFALL" states $show.yaml --json
  mv stdout $show.json
  exits 0 "$DOMEFALL" states $show.yaml
  mv stdout $show.csv
done
rays=$DOMEFALL_SOURCE/tests/reference/rays.csv
for method in table exact binet-dopri5; do
  exits 0 "$DOMEFALL" trace --table "$rays" --method $method
  mv stdout rays_$method.csv
done
for kind in kerr charged wormhole; do
  exits 0 "$DOMEFALL" trace --table "$DOMEFALL_SOURCE/tests/reference/${kind}_rays.csv"
  mv stdout rays_$kind.csv
done
python "$here/python_numbers.py" "$rays"
python "$here/python_errors.py"

# The lesson runs without matplotlib, too, and finds what it says in docs/python.md.
ln -s "$DOMEFALL_SOURCE/shows" shows
python -c 'import runpy, sys
sys.modules["matplotlib"] = None
runpy.run_path(sys.argv[1])' "$DOMEFALL_SOURCE/docs/falling_observer.py"
for found in 'formula by at most [0-9.]*e-1[3-9] M' 'formulas by at most [0-9.]*e-1[4-9] radians' \
  ' 2\.0 +42\.10$' ' 6\.0 +24\.20 +45\.00' '4/b is 1\.75 seconds' 'errs by at most [0-9.]*e-1[1-9]' \
  '^  255 +1\.98 +0\.29' 'matplotlib is not installed'; do
  grep -qE -- "$found" stdout || { cat stdout; fail "the lesson did not find '$found'"; }
done

# Neither numpy nor the libraries of images are loaded before they are needed.
python - <<'END'
import sys
import domefall
assert "numpy" not in sys.modules
domefall.Show("dome.yaml").frame(3)
maps = open("/proc/self/maps").read()
assert "TBB" in maps.upper() and "OpenImageIO" not in maps
END

# An installed module finds its assets beside it, as a damaged one shows, and the library that it
# loads.
cmake --install "$build" --prefix "$folder/prefix" >/dev/null
module=$(find prefix -name 'domefall*.so')
[ -f "$(dirname "$module")/domefall.pyi" ] || fail "no types stand beside $module"
printf '%s\n' "sky: {region_I: {background: $DOMEFALL_SOURCE/shows/assets/milky_way.exr, stars: none}}" \
  'timeline: [{duration_s: 1}]' >panorama.yaml
exits 0 env PYTHONPATH="$(dirname "$module")" "$DOMEFALL_PYTHON" - <<'END'
import os
import domefall
assert domefall.__file__.endswith(".so") and "prefix" in domefall.__file__, domefall.__file__
domefall.Show("panorama.yaml").frame(1)
assert "prefix/lib/domefall/modules/libdomefall_openimageio.so" in open("/proc/self/maps").read()
sky = "prefix/share/domefall/assets/milky_way.sky"
os.truncate(sky, 1000)
try:
    domefall.Show("dome.yaml").frame(12)
except domefall.InputError as error:
    assert sky in str(error), error
else:
    raise AssertionError("the sky was not the installed one")
END
