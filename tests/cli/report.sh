#!/usr/bin/env bash
# domefall report: every CSV has plausible rows within the stated errors, every plot is an SVG document, the pages
# link only to what is there; and without gnuplot it says so before it works.
source "$(dirname "$0")/common.bash"

exits 0 "$DOMEFALL" report --out report --quick --figures
python3 - report <<'END'
import csv, math, pathlib, re, sys
import xml.etree.ElementTree as xml
folder = pathlib.Path(sys.argv[1])

def rows(name, numbers):
    with open(folder / name) as file:
        found = list(csv.DictReader(file))
    for row in found:
        for column in numbers:
            assert math.isfinite(float(row[column])) and float(row[column]) >= 0, (name, row)
    return found

rays = rows('rays.csv', ['rays', 'undecided', 'phi_worst', 'phi_99', 'sky_worst', 'sky_99', 'ns_per_ray', 'build_us'])
classes = {(row['region'], row['difficulty']) for row in rays}
assert classes == {('I', 'ordinary'), ('I', 'edge'), ('I', 'far'), ('II', 'ordinary'), ('II', 'edge'),
                   ('II', 'deep'), ('IV', 'ordinary'), ('IV', 'deep')} | {
    (region, difficulty) for region in ('charge_I', 'charge_II', 'ellis', 'dngr', 'spin_I', 'spin_II')
    for difficulty in ('ordinary', 'edge')}, classes
# The default of each method, once for every class.  Of the table and the integral RayErrors knows the bounds; the
# integrators err by some times the tolerance, 1e-9, on the sky but for rays near the extremum of phi, which region
# IV sees.
methods = {row['method'] for row in rays}
for region, difficulty in classes:
    default = [row for row in rays if (row['region'], row['difficulty']) == (region, difficulty) and row['is_default'] == '1']
    assert len(default) == len({row['method'] for row in default}) == (
        7 if region in ('I', 'II', 'IV') else 6 if 'spin' in region else 4), default
    for row in default:
        assert float(row['sky_worst']) < 1e-5 and float(row['ns_per_ray']) > 1, row
        if difficulty != 'edge':
            assert row['undecided'] == '0' and float(row['phi_99']) < 1e-5, row
# More digits are asked for, more are had.
for method in methods - {'exact', 'chart'}:
    settings = sorted({float(row['setting']) for row in rays if row['method'] == method})
    total = [sum(float(row['sky_99']) for row in rays
                 if row['method'] == method and float(row['setting']) == setting) for setting in settings]
    coarse, fine = (total[0], total[-1]) if method == 'table' else (total[-1], total[0])
    assert fine < coarse / 100, (method, settings, total)

# Places along rays: what renders and the closed form within 1e-8, each integrator better by a finer tolerance.
methods = {name for name in methods if name != 'chart' and not re.match('mino|kerr', name)}
places = rows('positions.csv', ['tolerance', 'places', 'missing', 'r_worst', 'r_99', 'time_worst', 'time_99', 'ns_per_place'])
assert {row['method'] for row in places} == methods, places
assert {row['rays'] for row in places} == {'edge', 'others'}, places
for row in places:
    assert float(row['ns_per_place']) > 1, row
    for what in ('r', 'time'):
        assert float(row[what + '_99']) <= float(row[what + '_worst']), row
        if row['method'] in ('table', 'exact'):
            assert row['missing'] == '0' and 0 < float(row[what + '_worst']) < 1e-10, row
for method in methods - {'table', 'exact'}:
    for what in ('r_99', 'time_99'):
        coarse, *_, fine = [float(row[what]) for row in places if row['method'] == method and row['rays'] == 'others']
        assert fine < coarse / 100, (method, what, coarse, fine)

# What these hold FrameErrors, FrameCosts and OrbitErrors know.
frames = rows('frames.csv', ['rms', 'worst', 'seconds', 'copies'])
costs = rows('costs.csv', ['size', 'pixels', 'stars', 'seconds', 'copies'])
benchmark = rows('benchmark.csv', ['size', 'rms', 'worst', 'seconds', 'copies'])
orbits = rows('orbits.csv', ['energy_drift', 'angular_momentum_drift', 'norm_drift', 'r_error', 'phi_error', 'seconds'])
assert min(map(len, (frames, costs, orbits))) >= 10 and len(benchmark) == 3

drawn = sorted(folder.glob('*/*.svg'))
assert len(drawn) >= 20 + 2 + 3 + 2 + 6, len(drawn)
for file in drawn:
    root = xml.parse(file).getroot()
    assert root.tag.endswith('svg') and len(list(root.iter('{http://www.w3.org/2000/svg}path'))) > 10, file
page = (folder / 'accuracy.md').read_text() + (folder / 'costs.md').read_text()
links = re.findall(r'\]\(([^)]+)\)', page)
assert len(links) >= len(drawn)
for link in links:
    assert (folder / link).is_file(), link
assert not re.search(r'\b(nan|inf)\b', page), 'a number in the page is none'
print(f'{len(rays)} rows of rays, {len(frames)} of frames, {len(orbits)} of orbits, {len(costs)} of costs, {len(drawn)} drawings')
END
[ -z "$(find report -name '*.tmp')" ] || fail "temporaries were left"

# Without gnuplot nothing is begun.
mkdir empty
exits 75 env PATH="$folder/empty" "$DOMEFALL" report --out none --quick
says 'gnuplot-nox'
[ ! -e none ] || fail "a report was begun that could not be drawn"

# A folder that cannot be made, here and now.
touch occupied
exits 75 "$DOMEFALL" report --out occupied/report --quick
says '^occupied/report: '
exits 2 "$DOMEFALL" report --quick
