#!/usr/bin/env bash
# Where a verb is to write: a device or a pipe is written into and stays what it is, a link is followed and stays,
# and what can hold no file is refused.
source "$(dirname "$0")/common.bash"
write_grid_show tiny.yaml
exits 0 "$DOMEFALL" stars import csv "$DOMEFALL_SOURCE/shows/assets/stars_to_8.csv" --faintest 6 --out few.stars
exits 0 "$DOMEFALL" preview tiny.yaml --size 128x64 --out panorama.png
mkdir scratch
export TMPDIR=$folder/scratch

# Each verb, as a function of where it is to write.
plot() { "$DOMEFALL" states tiny.yaml --frames 0 --plot "$1"; }
stars() { "$DOMEFALL" stars import csv "$DOMEFALL_SOURCE/shows/assets/stars_to_8.csv" --faintest 5 --out "$1"; }
build() { "$DOMEFALL" sky build --stars few.stars --fainter-than 5 --blur 4 --size 32 --out "$1"; }
import() { "$DOMEFALL" sky import panorama.png --size 32 --stars few.stars --out "$1"; }
still() { "$DOMEFALL" preview tiny.yaml --size 64x36 --out "$1"; }
verbs="plot stars build import still"
for verb in $verbs; do exits 0 "$verb" "$verb.png"; done
# is_as VERB FILE: the file holds what the verb writes.
is_as() { cmp "$1.png" "$2" >&2 || fail "$1 did not write this into $2"; }
nothing_else() { [ -z "$(find . -name '.*.tmp' -o -path './scratch/*')" ] || fail "left: $(find . -name '.*')"; }

# Devices.  Only root could replace those in /dev; these stand for them.
if mknod full.png c 1 7 2>/dev/null && mknod null.png c 1 3 2>/dev/null && : 2>/dev/null >null.png; then
  mknod disk.png b 7 99
  for verb in $verbs; do
    exits 75 "$verb" full.png
    says '^full.png: No space left on device$'
    exits 0 "$verb" null.png
    exits 2 "$verb" disk.png
    says '^disk.png: is a disk'
    if [ ! -c full.png ] || [ ! -c null.png ] || [ ! -b disk.png ]; then fail "$verb replaced a device"; fi
  done
  ln -s full.png to_full.png
  exits 75 plot to_full.png
  if [ ! -L to_full.png ] || [ ! -c full.png ]; then fail "a link to a device was replaced"; fi
else
  exits 75 plot /dev/full
  exits 0 plot /dev/null
fi
nothing_else

# Pipes.
mkfifo pipe.png
for verb in $verbs; do
  cat pipe.png >read.png &
  exits 0 "$verb" pipe.png
  wait $!
  is_as "$verb" read.png
done
[ -p pipe.png ] || fail "the pipe was replaced"
exits 75 timeout 30 "$DOMEFALL" states tiny.yaml --frames 0 --plot pipe.png
says '^pipe.png: nobody reads this pipe$'
for verb in plot stars build import; do
  "$verb" >(cat >read.png) >/dev/null 2>&1
  wait $! # for the reader
  is_as "$verb" read.png
done

# The program's own descriptors, in the order of what else is written there.
"$DOMEFALL" states tiny.yaml --frames 0 >states.csv
cat plot.png states.csv >both
plot /dev/stdout >written
cmp both written || fail "a plot on standard output"
plot /dev/stdout | cmp both - || fail "a plot into a pipe"
echo before >written
plot /proc/self/fd/1 >>written
{ echo before; cat both; } | cmp - written || fail "a plot after something else"
exits 0 stars /dev/fd/1
is_as stars stdout

# Links are followed and stay.
mkdir away
ln -s away/target.png link.png
ln -s link.png link_to_link.png
for verb in $verbs; do
  for link in link.png link_to_link.png; do
    for before in none old; do
      rm -f away/target.png
      [ $before = none ] || echo old >away/target.png
      exits 0 "$verb" $link
      says "^$link: a link; the file is away/target.png\$"
      if [ ! -L link.png ] || [ ! -L link_to_link.png ]; then fail "$verb replaced a link"; fi
      is_as "$verb" away/target.png
    done
  done
done
ln -s circle.png circle.png
exits 2 plot circle.png
ln -s nowhere/target.png astray.png
exits 75 plot astray.png
nothing_else

# What can hold no file.
mkdir folder.png
python3 -c 'import socket; socket.socket(socket.AF_UNIX).bind("socket.png")'
for verb in $verbs; do
  exits 2 "$verb" folder.png
  exits 2 "$verb" socket.png
  exits 2 "$verb" away/
  exits 2 "$verb" "$(printf 'x%.0s' $(seq 300)).png"
  exits 75 "$verb" nowhere/x.png
done
[ -S socket.png ] || fail "a socket was replaced"
nothing_else

# A name that could be foreseen: what is planted there is not followed.
mkdir victim
echo dear >victim/linear.exr
exits 0 bash -c "ln -s '$folder/victim' \"\$TMPDIR/domefall_check_\$\$\" && exec '$DOMEFALL' check tiny.yaml"
grep -q '^to render' stdout || fail "nothing was measured"
[ "$(cat victim/linear.exr)" = dear ] || fail "a planted link was followed"
rm scratch/domefall_check_*
nothing_else
