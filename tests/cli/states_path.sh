#!/usr/bin/env bash
# The CSV of `domefall states` is a trajectory: given back as a path it leads to the same states, at its rows to
# rounding and between them to the error of its cubics, whether it orbits the hole or falls into it, about a hole
# that spins and in a wormhole, too.
source "$(dirname "$0")/common.bash"

# given_back SPACE TRAJECTORY TURNS [ERROR]: a show of it, and one of a path through every fourth of its
# states, which may miss those between by ERROR.
given_back() {
  local space=$1 trajectory=$2 turns=$3 error=${4:-1e-6}
  cat >first.yaml <<END
frames_per_second: 10
$space
timeline: [{duration_s: 40.1, trajectory: $trajectory}]
END
  exits 0 "$DOMEFALL" states first.yaml
  mv stdout first.csv
  grep -v '^#' first.csv | awk 'NR == 1 || (NR - 2) % 4 == 0' >kept.csv
  # The last state kept, that of frame 400, is the path's end.
  cat >second.yaml <<END
frames_per_second: 10
$space
timeline: [{duration_s: 40, trajectory: {type: path, file: kept.csv}}]
END
  exits 0 "$DOMEFALL" states second.yaml
  mv stdout second.csv
  python3 - "$turns" "$error" <<'END'
import csv, math, sys

def rows(name):
    with open(name) as f:
        return list(csv.DictReader(line for line in f if not line.startswith('#')))

first, second = rows('first.csv'), rows('second.csv')
assert len(first) == 401 and len(second) == 400, (len(first), len(second))
header = list(first[0])
assert header[header.index('dec_deg') + 1] == 'azimuth_deg', header
swept = float(first[-1]['azimuth_deg'])
assert abs(swept / 360 - float(sys.argv[1])) < 0.2, swept
worst = {True: 0.0, False: 0.0}
for a, b in zip(first, second):
    at_row = int(a['frame']) % 4 == 0
    error = max(abs(float(a[place]) - float(b[place])) / max(1, float(a['r'])) for place in ('r', 'l'))
    for angle in 'azimuth_deg', 'latitude_deg':
        error = max(error, math.radians(abs(float(a[angle]) - float(b[angle]))))
    # The motion is that of the rates, which are the file's, and the null time the path's own sum.
    for part in 'celerity_r', 'celerity_theta', 'celerity_phi':
        moved = abs(float(a[part]) - float(b[part]))
        assert moved <= (1e-11 if at_row else 1e-3), (part, a, b)
    assert abs(float(a['null_time']) - float(b['null_time'])) <= 10 * float(sys.argv[2]), (a, b)
    worst[at_row] = max(worst[at_row], error)
print('worst at rows and between them:', worst[True], worst[False])
assert worst[True] <= 1e-12  # roundings of 15 digits and of proper times of up to 100 M
assert worst[True] < worst[False] <= float(sys.argv[2])  # h^4/384 times the fourth derivative
END
}

hole='black_hole: {mass_solar: 10}'
given_back "$hole" '{type: parabolic, periastron: 6, from_r: 12, to_r: 12, to_leg: outward}' 1
given_back "$hole" '{type: infall, from_r: 12, to_r: 5}' 0

spin='black_hole: {mass_solar: 10, spin: 0.9}'
given_back "$spin" '{type: bound, periastron: 6, apoastron: 12, inclination_deg: 50, rate_m_per_s: 2}' 0.7
given_back "$spin" '{type: infall, from_r: 12, latitude_deg: 30, angular_momentum: 1, to_r: 1.2}' 0 1e-4
given_back 'wormhole: {radius_km: 10}' '{type: thrown, from_l: 5, speed: 0.3, direction: inward, to_l: -4}' 0

# Spreadsheets put a byte order mark before what they save as UTF-8.
printf '\xef\xbb\xbfproper_time,r\r\n0,12\r\n10,11\r\n' >marked.csv
cat >marked.yaml <<'SHOW'
black_hole: {mass_solar: 10}
timeline: [{duration_s: 1, trajectory: {type: path, file: marked.csv}}]
SHOW
exits 0 "$DOMEFALL" states marked.yaml

# A column that is nearly one of a path's was meant to be that.
printf 'proper_time,r,latitude\n0,12,30\n10,11,30\n' >marked.csv
exits 2 "$DOMEFALL" states marked.yaml
says "marked.csv:1: no path has a column 'latitude'; did you mean latitude_deg?"

# Out of region IV and back into II the tetrad changes: the halves are paths, the whole is none.
cat >crossing.yaml <<'SHOW'
frames_per_second: 10
black_hole: {mass_solar: 10}
timeline: [{duration_s: 8, trajectory: {type: kruskal, energy: 0.9, from_r: 0.5, to_r: 0.5, to_leg: inward}}]
SHOW
exits 0 "$DOMEFALL" states crossing.yaml
cp stdout whole.csv
grep -v ',rain,' stdout >out.csv
grep -v ',outgoing,' stdout >in.csv
for part in whole out in; do
  cat >$part.yaml <<SHOW
black_hole: {mass_solar: 10}
timeline: [{duration_s: 4, trajectory: {type: path, file: $part.csv}}]
SHOW
done
first=$(grep -n -m1 '^[0-9].*,rain,' whole.csv | cut -d: -f1)
exits 2 "$DOMEFALL" states whole.yaml
says "whole.csv:$first: the tetrad changes; a path has one, give each part a file and a segment"
exits 0 "$DOMEFALL" states out.yaml
exits 0 "$DOMEFALL" states in.yaml
