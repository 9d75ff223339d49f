#!/usr/bin/env bash
# What is no regular file is told by name at once wherever a file is read, and is never waited for.
source "$(dirname "$0")/common.bash"
write_show fall.yaml
mkfifo pipe.exr
mkdir folder

# refused COMMAND...: within five seconds, most of which a busy machine may need to load libraries.
refused() { exits 2 timeout 5 "$DOMEFALL" "$@"; }

for input in pipe.exr /dev/zero folder; do
  refused check "$input"
  says "^$input: this is a "
  refused render "$input" --out o
  says "^$input: this is a "
  refused stars import csv "$input" --out o.stars
  says "^$input: this is a "
  refused sky import "$input" --out o.sky
  says "^$input: this is a "
  refused trace --table "$input"
  says "^$input: this is a "
done

# named KEY: the show names the pipe there.
named() {
  { grep -v '^sky' fall.yaml; printf '%s\n' "$1"; } >named.yaml
  refused check named.yaml
  says "^named.yaml:[0-9]+:[0-9]+: .* 'pipe.exr', which is no regular file"
}
named 'sky: {region_I: {background: pipe.exr}}'
named 'sky: {region_I: {stars: {catalogue: pipe.exr}}}'
named 'grade: {config: pipe.exr}'
printf 'timeline: [{duration_s: 1, trajectory: {type: path, file: pipe.exr}}]\nblack_hole: {mass_solar: 10}\n' >path.yaml
refused check path.yaml
says "^path.yaml:[0-9]+:[0-9]+: .* 'pipe.exr', which is no regular file"

# A file of /proc calls itself regular and empty, and waits for news when it is read.
ln -s /proc/kmsg news
refused check news
says '^news:1:1: the show is empty'
for left in o o.sky o.stars; do
  [ ! -e "$left" ] || fail "a refused input left $left"
done
