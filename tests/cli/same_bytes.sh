#!/usr/bin/env bash
# A frame is the same bytes with 1 and 2 threads, alone or in a run, in any order, from any folder.
source "$(dirname "$0")/common.bash"
write_show fall.yaml
exits 0 "$DOMEFALL" render fall.yaml --out one --threads 1
exits 0 "$DOMEFALL" render fall.yaml --out two --threads 2
same_frames one two
for frame in 23 0 12 11; do exits 0 "$DOMEFALL" render fall.yaml --out alone --frames "$frame"; done
mkdir elsewhere
(cd elsewhere && exits 0 "$DOMEFALL" render ../fall.yaml --out ../alone --frames 1-10,13-22)
same_frames one alone
# Not on a terminal: no progress bar.
if grep -q $'\r' "$folder/stderr"; then fail "a progress bar in a file"; fi
