#!/usr/bin/env bash
# A file that a show names and that is not there may be there on another machine, or in a minute:
# 75, so that a farm tries elsewhere. What the show itself says wrongly stays 2.
source "$(dirname "$0")/common.bash"

# shown YAML: a show of one still with these lines
shown() { printf '%s\ntimeline: [{duration_s: 1}]\n' "$1" >show.yaml; }
# missing CODE PATTERN: checking and rendering it end with that code and say why
missing() {
  exits "$1" "$DOMEFALL" check show.yaml
  says "$2"
  exits "$1" "$DOMEFALL" render show.yaml --size 64 --frames 0 --out out
  says "$2"
  [ ! -e out ] || fail "a folder was made"
}

shown 'sky: {region_I: {background: none.exr}}'
missing 75 "^show.yaml:1:30: .* 'none.exr', which is neither beside the show nor in the working folder$"
shown 'sky: {region_I: {stars: none.stars}}'
missing 75 "^show.yaml:1:25: .* 'none.stars'"
shown 'grade: {config: none.ocio}'
missing 75 "^show.yaml:1:17: .* 'none.ocio'"
shown 'title: No assets'
DOMEFALL_ASSETS=$folder missing 75 'milky_way.sky, which is missing from '

# Mistakes count for more than missing files, and both are listed.
shown 'sky: {region_I: {background: none.exr, stars: 3}}'
missing 2 "'none.exr'"
says '^show.yaml:1:47: '
mkdir folder.exr
shown 'sky: {region_I: {background: folder.exr}}'
missing 2 'which is a folder$'

# The tables of a colour configuration are looked for when it is read.
cat >tables.ocio <<'END'
ocio_profile_version: 2
search_path: .
roles: {default: ACEScg, scene_linear: ACEScg, color_timing: ACEScg, aces_interchange: ACEScg}
displays:
  Dome:
    - !<View> {name: Through a table, colorspace: table}
colorspaces:
  - !<ColorSpace> {name: ACEScg}
  - !<ColorSpace> {name: table, from_scene_reference: !<FileTransform> {src: none.cube}}
END
shown 'grade: {config: tables.ocio}'
missing 75 'none.cube'
