#!/usr/bin/env bash
# Verbs that do not exist and numbers out of range are told in plain words, and end with 2.
source "$(dirname "$0")/common.bash"
write_grid_show show.yaml

# An option is no value of the one before it.
exits 2 "$DOMEFALL" farm submit show.yaml --engine local --out frames --deliver --dry-run
says '^--deliver: got the option --dry-run; a file of this name is \./--dry-run$'
exits 2 "$DOMEFALL" movie show.yaml
says '^--preset is required'
exits 2 "$DOMEFALL" movie show.yaml --preset vr360
says '^--preset vr360: takes frames of the projection equirectangular, and those of this show are domemaster$'
exits 2 "$DOMEFALL" movie show.yaml --preset reveiw
says '^--preset reveiw: there is no such preset; did you mean review\?$'
exits 2 "$DOMEFALL" rendr show.yaml
says "^domefall has no verb 'rendr'; did you mean render\?$"
exits 2 "$DOMEFALL" zzz
says "^domefall has no verb 'zzz'; it has check, render, .* or sky$"
exits 2 "$DOMEFALL"
says 'subcommand is required'

exits 2 "$DOMEFALL" preview show.yaml --out a.png --fov 1e400
says '^--fov: 1e400 is not from 0.001 to 340$'
exits 2 "$DOMEFALL" preview show.yaml --out a.png --fov nan
says '^--fov: nan is not from 0.001 to 340$'
exits 2 "$DOMEFALL" preview show.yaml --out a.png --fov wide
says "^--fov: 'wide' is not a number$"
exits 2 "$DOMEFALL" preview show.yaml --out a.png --frame 99999999999999
says '^--frame: 99999999999999 is not from 0 to 9999999$'
exits 2 "$DOMEFALL" preview show.yaml --out a.png --frame -1
says '^--frame: -1 is not from 0 to 9999999$'
exits 2 "$DOMEFALL" render show.yaml --out frames --threads 4096
says '^--threads: 4096 is not from 0 to 1024$'
