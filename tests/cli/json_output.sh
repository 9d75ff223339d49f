#!/usr/bin/env bash
# --json of `states`, `probe` and `sky info`: the facts of the text with all digits, null for what is
# not there, and rays that `trace` finds, too.
source "$(dirname "$0")/common.bash"
cat >fall.yaml <<'END'
frames_per_second: 2
size: 200
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {background: black, stars: none}}
timeline:
  - {duration_s: 2, trajectory: {type: infall, from_r: 4, to_r: 0.5}}
  - {duration_s: 1, trajectory: {type: kruskal, energy: 0.9, from_r: 0.5, to_r: 0.9}}
  - {duration_s: 1, trajectory: {type: static, r: 5}, camera: {look_at: hole}}
END
cat >flat.yaml <<'END'
size: 200
sky: {region_I: {background: black, stars: none}}
timeline: [{duration_s: 1, trajectory: {type: velocity, speed: 0.6, direction: Vega}}]
END
cat >stars.yaml <<'END'
size: 64
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {background: black, stars: naked_eye}}
timeline: [{duration_s: 1, trajectory: {type: infall, from_r: 15, to_r: 10}, camera: {look_at: hole}}]
END
cat >still.yaml <<'END'
size: 64
sky: {region_I: {background: black, stars: naked_eye}}
timeline: [{duration_s: 1, camera: {look_at: Sirius, elevation_deg: 90}}]
END

python3 - "$DOMEFALL" <<'END'
import csv, json, math, random, re, subprocess, sys


def domefall(*arguments):
    return subprocess.run([sys.argv[1], *arguments], check=True, capture_output=True, text=True).stdout


def parsed(text):
    return json.loads(text, parse_constant=lambda name: sys.exit('not JSON: ' + name))


# The same columns; the digits of the CSV are a rounding of those in JSON.
for show in ('fall.yaml', 'flat.yaml'):
    table = domefall('states', show, '--frames', '0-5,7')
    rows = list(csv.DictReader(line for line in table.splitlines() if not line.startswith('#')))
    states = parsed(domefall('states', show, '--frames', '0-5,7', '--json'))
    assert len(rows) == len(states) == 7
    for row, state in zip(rows, states):
        of_camera = ['projection', 'fov_deg', 'width', 'height', 'pixel_aspect', 'world_from_camera',
                     'world_from_audience']
        assert list(row) + of_camera == list(state), (row, state)
        for key in of_camera:
            del state[key]
        for key, value in state.items():
            if value is None:
                assert row[key] in ('inf', '-inf', 'nan'), (key, row)
            elif isinstance(value, str):
                assert row[key] == value, (key, row, value)
            elif key in ('show_time_s', 'ra_deg', 'dec_deg', 'azimuth_deg'):
                assert abs(float(row[key]) - value) <= 1e-8 * abs(value), (key, row, value)
            else:
                assert float(row[key]) == value, (key, row, value)
states = parsed(domefall('states', 'fall.yaml', '--json'))
assert {s['region'] for s in states} > {'I', 'II'}, states


def direction(x, y):  # through a place of the Domemaster, by the paper's formula
    right, down = (x - 100.5) / 100, (y - 100.5) / 100
    theta, azimuth = math.hypot(right, down) * math.pi / 2, math.atan2(down, right)
    return math.sin(theta) * math.cos(azimuth), math.sin(theta) * math.sin(azimuth), math.cos(theta)


def shown(show, frame, x, y):
    command = ['probe', show, '--frame', str(frame), '--pixel', f'{x:.17g},{y:.17g}']
    return parsed(domefall(*command, '--json')), domefall(*command)


def near(text, value, tolerance=2e-6):
    assert abs(float(text) - value) <= tolerance * max(1, abs(value)), (text, value)


# The light of Planck's law in V, in steps of 1 nm, with Bessell's V (1990) between its points.
V = [0, .03, .163, .458, .78, .967, 1, .973, .898, .792, .684, .574, .461, .359, .27, .197, .135, .081, .045, .025,
     .017, .013, .009, 0]


def light_in_v(kelvin):
    def weight(nm):
        k, part = divmod(nm - 470, 10)
        return V[k] + (V[k + 1] - V[k]) * part / 10
    return sum(weight(nm) / nm ** 5 / math.expm1(1.438776877e7 / (nm * kelvin)) for nm in range(470, 700))


rng = random.Random(16)
compared = 0
for frame in (0, 2, 3, 4, 7):
    state = states[frame]
    rays = []
    for _ in range(4):
        x, y = rng.uniform(30, 170), rng.uniform(30, 170)
        fact, text = shown('fall.yaml', frame, x, y)
        assert fact['pixel'] == [x, y] and fact['inside'] and fact['frame'] == frame
        assert (fact['region'], fact['r']) == (state['region'], state['r'])
        said = re.search(r'sees .*(?:sky|region) (III|IV|I), RA (\S+) deg, Dec (\S+) deg', text)
        assert said[1] == fact['sky'], (said, fact)
        near(said[2], fact['ra_deg'])
        near(said[3], fact['dec_deg'])
        ra, dec = math.radians(fact['ra_deg']), math.radians(fact['dec_deg'])
        place = math.cos(dec) * math.cos(ra), math.cos(dec) * math.sin(ra), math.sin(dec)
        for a, b in zip(fact['direction'], place):
            near(a, b, 1e-12)
        said = re.search(r'compression +(\S+) towards the hole, (\S+) across', text)
        near(said[1], fact['compression_towards_hole'], 1e-5)
        near(said[2], fact['compression_across'], 1e-5)
        # An observer in region IV sees no sky, and so no edge of one.
        assert (fact['to_edge_deg'] is None) == (state['region'] == 'IV'), fact
        shift = re.search(r'1 \+ z +(\S+)', text)
        if fact['sky'] == 'IV':
            absent = 'one_plus_z', 'temperature_ratio', 'intensity_ratio', 'amplification', 'order'
            assert shift is None and all(fact[key] is None for key in absent), fact
        else:
            near(shift[1], fact['one_plus_z'], 1e-8)
            near(fact['temperature_ratio'] * fact['one_plus_z'], 1, 1e-14)
            near(fact['intensity_ratio'] * fact['one_plus_z'] ** 4, 1, 1e-13)
            assert fact['order'] == fact['swept_azimuth_deg'] // 180
        if all(state['celerity_' + axis] == 0 for axis in ('r', 'theta', 'phi')):
            n = direction(x, y)
            inward = -sum(n[k] * state['xyz'[k] + '_r'] for k in range(3))
            rays.append((math.acos(inward), fact))
    if not rays:
        continue
    with open('rays.csv', 'w') as f:
        f.write('observer,r,delta,edge,offset\n')
        f.writelines(f"{state['tetrad']},{state['r']!r},{delta!r},,\n" for delta, _ in rays)
    for method in ('table', 'exact'):
        table = domefall('trace', '--table', 'rays.csv', '--method', method)
        for ray, (_, fact) in zip(csv.DictReader(table.splitlines()), rays, strict=True):
            assert ray['origin'] == fact['sky'], (ray, fact)
            compared += 1
            if fact['sky'] != 'IV':
                near(ray['one_plus_z'], fact['one_plus_z'], 1e-9)
                near(math.degrees(float(ray['phi'])), fact['swept_azimuth_deg'], 1e-8)
assert compared >= 24, compared

# The images of stars on a pixel: the ray through the middle of each comes from the star.
orders = set()
for show, places in (('stars.yaml', ((24, 42), (32, 50), (38, 44))), ('still.yaml', ((32.5, 32.5),))):
    for x, y in places:
        fact, text = shown(show, 0, x, y)
        stars = fact['stars']
        # The text has the brightest twelve, and how many more.
        fainter = re.search('^stars +([0-9]+) fainter', text, re.M)
        told = len(re.findall('^star  ', text, re.M))
        assert 1 <= told == min(len(stars), 12), (fact, text)
        assert int(fainter[1] if fainter else 0) == len(stars) - told, (fact, text)
        assert [s['seen_v'] for s in stars] == sorted(s['seen_v'] for s in stars)
        for star in stars[:2] + [s for s in stars if s['order'] > 0][:2]:
            orders.add(star['order'])
            assert math.hypot(star['pixel'][0] - x, star['pixel'][1] - y) < 4, star
            there, _ = shown(show, 0, *star['pixel'])
            assert there['sky'] == star['sky'] and (there['order'] or 0) == star['order'], (there, star)
            near(star['dec_deg'], there['dec_deg'], 1e-7)
            near(0, math.remainder(star['ra_deg'] - there['ra_deg'], 360), 1e-5)
            squeezed = there['compression_towards_hole'] * there['compression_across']
            # Of g^4 of the star's flux, its new temperature leaves another part in V.
            kelvin, g = star['temperature_k'], there['temperature_ratio']
            light = light_in_v(g * kelvin) / light_in_v(kelvin) / squeezed
            near(star['seen_v'], star['v'] - 2.5 * math.log10(light), 0.01)
assert orders >= {0, 1}, orders
brightest = stars[0]
assert 'Sirius' in brightest['names'] and brightest['order'] == 0, brightest
near(brightest['seen_v'], -1.44, 0.02)

fact, text = shown('flat.yaml', 0, 50, 60)
assert fact['region'] is None and fact['r'] is None and fact['to_edge_deg'] is None, fact
assert fact['order'] is None and fact['sky'] == 'I'
fact, text = shown('flat.yaml', 0, 1, 1)
assert not fact['inside'] and 'outside' in text
END

oiiotool --pattern fill:left=0.1,0.2,0.3:right=0.9,0.5,0.1 64x32 3 -o picture.exr
exits 0 "$DOMEFALL" sky import picture.exr --frame galactic --centre-ra 30 --fainter-than 8.5 \
  --licence $'caf\xe9 & "quotes"' --out picture.sky
exits 0 "$DOMEFALL" sky info picture.sky
mv stdout page
exits 0 "$DOMEFALL" sky info picture.sky --json
mv stdout unverified
exits 0 "$DOMEFALL" sky info picture.sky --json --verify
python3 - <<'END'
import json
with open('unverified', encoding='utf-8') as f:
    facts = json.load(f)
with open('stdout', encoding='utf-8') as f:
    verified = json.load(f)
with open('page', 'rb') as f:
    page = f.read().decode(errors='replace')
assert facts.pop('verified') is None and verified.pop('verified') is True
assert facts == verified
assert facts['kind'] == 'colour' and facts['unit_name'] == 'cd/m^2'
assert f"unit         {facts['unit']:.9g} cd/m^2\n" in page
size = facts['face_size']
assert f"6 of {size} x {size}, {facts['levels']} levels, {facts['bytes'] / 1e6:.1f} MB" in page
galactic = {'frame': 'galactic', 'longitude_grows': 'left', 'up': 'north', 'centre_deg': 30}
assert facts['picture'] == galactic, facts
assert facts['fainter_than'] == 8.5, facts
# The page spells a byte that is no character, in whose place JSON has U+FFFD.
assert page.endswith(facts['text'].replace('\ufffd', '\\xE9')) and '& "quotes"' in facts['text'], facts
assert len(facts['digest']) >= 16
END
printf 'X' | dd of=picture.sky bs=1 seek=5000 conv=notrunc status=none
exits 2 "$DOMEFALL" sky info picture.sky --json --verify
says '^picture.sky: '
[ ! -s stdout ] || fail "half a JSON"
