#!/usr/bin/env bash
# domefall check: a page to read, and the same facts as JSON; warnings do not make it fail; a damaged file does.
source "$(dirname "$0")/common.bash"

cat >around.yaml <<'END'
title: "Around \"it\""
frames_per_second: 10
size: 256
black_hole: {mass_solar: 4.3e6}
markers: {turn: 0:03, plunge: 7.04}
fade_in_s: 0:01
timeline:
  - {duration_s: 6, trajectory: {type: parabolic, periastron: 6, from_r: 20, to_r: 20, to_leg: outward}}
  - {duration_s: 2, trajectory: {type: continue, rate_m_per_s: 100}}
  - {duration_s: 4, dissolve_s: 1, trajectory: {type: infall, from_r: 8, to_r: 0.5}, camera: {look_at: outward}}
  - {duration_s: 2, fade_out_s: 1.5, trajectory: {type: static, r: 3}}
END

exits 0 "$DOMEFALL" check around.yaml
[ "$(wc -l <stdout)" -le 60 ] || fail "more than a page"
tells '^title +Around "it"$'
tells '^frames +130 at 10 a second \(13 s\), domemaster of 256 x 256$'
tells '^graded for +Dome G2\.2 Rec\.709, Dome$'
tells '^fading +fades in for 1 s$'
tells '^marker +turn at 0:03 \(3 s\), frame 30, segment 1$'
tells '^marker +plunge at 0:07\.04 \(7\.04 s\), frame 70, segment 3$'
tells '^ +fades out for 1\.5 s$'
tells '^on disk +about [0-9.]+ [kM]B: 130 frames of [0-9.]+ kB scene-linear and [0-9.]+ kB graded; [0-9.]+ .B free at out/around$'
tells '^segment 1 +parabolic, 0 s to 6 s$'
tells '^sky +milky_way.sky, the light of stars fainter than V = 9; stars_to_9.stars, 131,085 stars to V = 9$'
tells 'r = 20 M to 20 M, closest 6 M at 3 s; region I$'
tells '^segment 3 +infall, 7 s to 11 s$'
tells '^ +-- joint at 6 s: the motion goes on$'
tells '^ +-- dissolve of 1 s at 7 s: r jumps from '
tells '^ +-- cut at 11 s: region II to I; r jumps from 0\.5 M to 3 M$'
tells '^regions +I, II, I$'
tells '^closest +r = 0\.5 M, frame 1(09|10) '
tells '^fastest +[01]'
tells '^bluest sky +1 \+ z = 0\.'
tells '^reddest sky +1 \+ z = [1-9]'
tells '^brightest +frame [0-9]+ .* mean luminance'
tells '^to render +about .* on this machine with [0-9]+ threads? at 256 x 256'
tells '^ +6 s, frame 60, segment 2: the motion goes on, but its clock jumps from '
cp stdout page

exits 0 "$DOMEFALL" check around.yaml --json
python3 - stdout page <<'END'
import json, sys
with open(sys.argv[1]) as f:
    facts = json.load(f, parse_constant=lambda name: sys.exit('not JSON: ' + name))
assert facts['title'] == 'Around "it"'
assert facts['frames'] == 130 and facts['duration_s'] == 13 and facts['width'] == 256
assert facts['fade_in_s'] == 1 and facts['segments'][3]['fade_out_s'] == 1.5
assert [s['type'] for s in facts['segments']] == ['parabolic', 'parabolic', 'infall', 'static']
closest = facts['segments'][0]['closest']
assert abs(closest['value'] - 6) < 1e-9 and abs(closest['time_s'] - 3) < 1e-5, closest
assert facts['segments'][2]['regions'] == ['I', 'II'] and facts['regions'] == ['I', 'II', 'I']
assert abs(facts['closest_r']['value'] - 0.5) < 1e-9
assert [(m['name'], m['time_s'], m['frame'], m['segment']) for m in facts['markers']] == [
    ('turn', 3, 30, 1), ('plunge', 7.04, 70, 3)], facts['markers']
disk = facts['disk']
assert disk['free_bytes'] > 0
assert disk['measured'] and disk['frame_linear_bytes'] > 20000 and disk['frame_graded_bytes'] > 20000
assert abs(disk['bytes'] / 130 / (disk['frame_linear_bytes'] + disk['frame_graded_bytes']) - 1) < 1e-9
assert 0 < facts['fastest_speed']['value'] < 1 <= facts['fastest_lorentz_factor']['value']
assert facts['least_one_plus_z']['value'] < 1 < facts['largest_one_plus_z']['value']
assert facts["joints"][1]["segment"] == 3 and facts["joints"][1]["dissolve_s"] == 1 and facts['joints'][0]['velocity_jump'] < 1e-6
assert len(facts['warnings']) == 1 and facts['warnings'][0]['frame'] == 60, facts['warnings']
assert facts['render']['seconds'] > 0 and facts['render']['threads'] >= 1
assert facts['brightest']['mean'] >= facts['darkest']['mean'] > 0
END

# What is kept decides the size; where it does not fit, check says so.
cat >small.yaml <<'END'
size: 64
sky: {region_I: {background: grid, stars: none}}
output: {linear: none, graded: png8}
timeline: [{duration_s: 10}]
END
exits 0 "$DOMEFALL" check small.yaml --out nowhere/yet
tells '^on disk +about [0-9.]+ [kM]B: 300 frames of [0-9.]+ kB graded; [0-9.]+ .B free at nowhere/yet$'
if (mkdir full && mount -t tmpfs -o size=64k none full) 2>/dev/null; then
  exits 0 "$DOMEFALL" check small.yaml --out full/frames
  umount full
  tells 'warnings'
  tells 'all 300 frames take about [0-9.]+ [kM]B, and the disk of full/frames has 65.5 kB free; another --out'
fi

# Flat space; infinities are null.
cat >flat.yaml <<'END'
size: 64
output: {graded: none}
timeline: [{duration_s: 2, trajectory: {type: velocity, speed: 0.6, direction: Vega}}]
END
exits 0 "$DOMEFALL" check flat.yaml
tells '^black hole +none: flat space$'
tells '^fastest +0\.6 of '
tells '^reddest sky +1 \+ z = 2,'
tells '^no warnings$'
exits 0 "$DOMEFALL" check flat.yaml --json
python3 -c 'import json, sys
facts = json.load(open("stdout"))
assert facts["segments"][0]["from_r"] is None and facts["closest_r"] is None
assert facts["display"] is None and facts["mass_solar"] is None'

# Where no temporary file can be written all else is still said.
exits 0 env TMPDIR="$folder/nowhere/at/all" "$DOMEFALL" check flat.yaml
tells '^to render +not measured'

# A show that is rendered almost as soon as its time is measured has none.
printf 'size: 64\nframes_per_second: 1\nsky: {region_I: {background: grid, stars: none}}\n%s\n' \
  'timeline: [{duration_s: 2}]' >short.yaml
exits 0 "$DOMEFALL" check short.yaml
tells '^to render +not measured: to render the show is almost as quick$'
exits 0 "$DOMEFALL" check short.yaml --json
python3 -c 'import json; assert json.load(open("stdout"))["render"] is None'

# Uncompressed floats with layers, mattes and data take as much as is said where nothing is measured,
# but for headers.
cat >large.yaml <<'END'
size: 256
frames_per_second: 1
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {background: grid, stars: none}}
disc: {}
bodies: {beacon: {r: 9}, other: {r: 12}}
timeline: [{duration_s: 2, trajectory: {type: static, r: 20}, titles: [{text: one}]}]
output: {graded: tiff16, graded_alpha: true, linear: float, compression: none, layers: [sky, disc, titles], data: [lens, mattes, cryptomatte]}
END
sed 's/layers: /layer_files: true, &/' large.yaml >apart.yaml
sed '/^output/d' large.yaml >halves.yaml
echo 'output: {graded: none, compression: none}' >>halves.yaml
for show in large apart halves; do
  exits 0 "$DOMEFALL" check $show.yaml --json
  cp stdout said
  exits 0 "$DOMEFALL" check $show.yaml
  tells '^on disk +at most '
  exits 0 "$DOMEFALL" render $show.yaml --out $show
  python3 - $show <<'END'
import json, os, sys
said = json.load(open('said'))['disk']
assert not said['measured'], said
made = {'linear': 0, 'graded': 0}
for folder, _, files in os.walk(sys.argv[1]):
    for name in files:
        kind = 'graded' if name.endswith('.tif') else 'linear' if name.endswith('.exr') else None
        if kind: made[kind] += os.path.getsize(os.path.join(folder, name)) / 2
assert made['linear'] <= said['frame_linear_bytes'] <= 1.1 * made['linear'], (made, said)
assert made['graded'] <= said['frame_graded_bytes'], (made, said)
END
done

# Planets among the stars are told with their year.
printf 'size: 64\nframes_per_second: 1\nbegins_year: 2020.5\nsky: {planets: true}\n%s\n' \
  'timeline: [{duration_s: 2}]' >planets.yaml
exits 0 "$DOMEFALL" check planets.yaml
tells '^sky .* 131,085 stars to V = 9, and the planets of 2020\.5$'
exits 0 "$DOMEFALL" check planets.yaml --json
python3 -c 'import json; assert json.load(open("stdout"))["skies"][0]["planets_year"] == 2020.5'

# Files that are there but damaged are told.
printf 'not a picture' >broken.tif
printf 'sky: {region_I: {background: broken.tif}}\ntimeline: [{duration_s: 2}]\n' >panorama.yaml
exits 2 "$DOMEFALL" check panorama.yaml
says 'broken\.tif'
[ ! -s stdout ] || fail "talk on stdout"
printf 'ra_deg,dec_deg,v_mag,b_v\n1,2,x,0\n' >broken.csv
printf 'sky: {region_I: {background: black, stars: broken.csv}}\ntimeline: [{duration_s: 2}]\n' >stars.yaml
exits 2 "$DOMEFALL" check stars.yaml
says 'broken\.csv'
printf 'grade: {display: Nonsuch}\ntimeline: [{duration_s: 2}]\n' >grade.yaml
exits 2 "$DOMEFALL" check grade.yaml
says 'Nonsuch'

# Rates of video are taken for what they mean, with one note.
rated() { # rated RATE
  printf 'size: 64\nframes_per_second: %s\nsky: {region_I: {background: grid, stars: none}}\n%s\n' "$1" \
    'timeline: [{duration_s: 10}]' >rated.yaml
  exits 0 "$DOMEFALL" check rated.yaml
}
rated 23.98
tells '^frames +240 at 23\.976 \(24000/1001\) a second '
tells '^rate +23\.98 is taken for 24000/1001, the rate of video that it stands for$'
[ "$(grep -c 23.98 stdout)" -eq 1 ] || fail "more than one note"
exits 0 "$DOMEFALL" check rated.yaml --json
grep -q '"frame_rate":"24000/1001","frames_per_second_written":23.98,' stdout || fail "no note in JSON: $(cat stdout)"
rated 24000/1001
tells '^frames +240 at 23\.976 \(24000/1001\) a second '
! grep -q '^rate' stdout || fail "a note for a fraction"
