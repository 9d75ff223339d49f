#!/usr/bin/env bash
# The CSV of `domefall states` is a trajectory: given back as a path it leads to the same states, at its rows to
# rounding and between them to the error of its cubics, whether it orbits the hole or falls into it.
source "$(dirname "$0")/common.bash"

# given_back TRAJECTORY TURNS: a show of it, and one of a path through every fourth of its states.
given_back() {
  local trajectory=$1 turns=$2
  cat >first.yaml <<END
frames_per_second: 10
black_hole: {mass_solar: 10}
timeline: [{duration_s: 40.1, trajectory: $trajectory}]
END
  exits 0 "$DOMEFALL" states first.yaml
  mv stdout first.csv
  grep -v '^#' first.csv | awk 'NR == 1 || (NR - 2) % 4 == 0' >kept.csv
  # The last state kept, that of frame 400, is the path's end.
  cat >second.yaml <<END
frames_per_second: 10
black_hole: {mass_solar: 10}
timeline: [{duration_s: 40, trajectory: {type: path, file: kept.csv}}]
END
  exits 0 "$DOMEFALL" states second.yaml
  mv stdout second.csv
  python3 - "$turns" <<'END'
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
    error = max(abs(float(a['r']) - float(b['r'])) / max(1, float(a['r'])),
                math.radians(abs(float(a['azimuth_deg']) - float(b['azimuth_deg']))))
    worst[at_row] = max(worst[at_row], error)
print('worst at rows and between them:', worst[True], worst[False])
assert worst[True] <= 1e-12  # roundings of 15 digits and of proper times of up to 100 M
assert worst[True] < worst[False] <= 1e-6  # h^4/384 times the fourth derivative, steps of about 1 M
END
}

given_back '{type: parabolic, periastron: 6, from_r: 12, to_r: 12, to_leg: outward}' 1
given_back '{type: infall, from_r: 12, to_r: 5}' 0

# Spreadsheets put a byte order mark before what they save as UTF-8.
printf '\xef\xbb\xbfproper_time,r\r\n0,12\r\n10,11\r\n' >marked.csv
cat >marked.yaml <<'SHOW'
black_hole: {mass_solar: 10}
timeline: [{duration_s: 1, trajectory: {type: path, file: marked.csv}}]
SHOW
exits 0 "$DOMEFALL" states marked.yaml

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
