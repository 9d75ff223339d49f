#!/usr/bin/env bash
# Shows as long as a show file may be are read and followed in seconds. Each step that looks at all
# segments for each segment would take a minute or more.
source "$(dirname "$0")/common.bash"

# segments COUNT TEXT: as many lines
segments() { awk -v n="$1" -v text="$2" 'BEGIN { for (; n > 0; --n) print text }'; }

{
  printf 'sky: {region_I: {background: grid, stars: none}}\ntimeline:\n'
  segments 50000 '- {duration_s: 1}'
} >flat.yaml
exits 0 timeout 60 "$DOMEFALL" probe flat.yaml --frame 1499999 --pixel 100,100

# Around a hole each segment takes over its place and its clock from the one before.
{
  printf 'black_hole: {mass_solar: 4e6}\nsky: {region_I: {background: grid, stars: none}}\n'
  printf 'timeline:\n- {duration_s: 1, trajectory: {type: circular, r: 8, orbits: 1}}\n'
  segments 15000 '- {duration_s: 1, trajectory: {type: continue, rate_m_per_s: 100}}'
} >orbit.yaml
exits 0 timeout 60 "$DOMEFALL" probe orbit.yaml --frame 449999 --pixel 100,100
