#!/usr/bin/env bash
# A colour configuration that takes 2^40 steps to read: the bound on processor time ends the trial of it
# and not the program, and whoever stops the program meanwhile stops the trial, too.
source "$(dirname "$0")/common.bash"
write_show fall.yaml
{
  cat fall.yaml
  echo 'grade: {config: endless.ocio}'
} >endless.yaml
{
  cat <<'CONFIG'
ocio_profile_version: 2
search_path: ""
roles: {default: s0, scene_linear: s0}
file_rules:
  - !<Rule> {name: Default, colorspace: default}
displays:
  d: [!<View> {name: v, colorspace: s1}]
colorspaces:
  - !<ColorSpace> {name: s0, aliases: [ACEScg, lin_ap1]}
  - !<ColorSpace> {name: ACES2065-1}
  - !<ColorSpace> {name: s41}
CONFIG
  for k in $(seq 40); do
    both="!<ColorSpaceTransform> {src: s0, dst: s$((k + 1))}"
    echo "  - !<ColorSpace> {name: s$k, from_scene_reference: !<GroupTransform> {children: [$both, $both]}}"
  done
} >endless.ocio

exits 2 timeout 60 "$DOMEFALL" check endless.yaml
says 'endless.ocio: to read it takes more than 5 s of processor time'

# Asked to stop during the trial.
"$DOMEFALL" check endless.yaml 2>stderr &
program=$!
trial=
until [ -n "$trial" ]; do
  kill -0 $program || fail "no trial: $(cat stderr)"
  read -r trial <"/proc/$program/task/$program/children" || true
done
kill -TERM $program
ended 143 $program
for _ in $(seq 100); do
  grep -q '^State:.[^ZX]' "/proc/$trial/status" 2>/dev/null || exit 0
  sleep 0.01
done
fail "the trial goes on without the program"
