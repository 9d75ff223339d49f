#!/usr/bin/env bash
# What may happen to the folder of a run: each with a line that names the place, at once, and with the
# code by its cause. 2 where the path can never be right, 75 where it may be in a minute or elsewhere.
source "$(dirname "$0")/common.bash"
chmod 755 "$folder"
write_show fall.yaml
render() { timeout 20 "$DOMEFALL" render fall.yaml --frames 0-2 "$@"; }
exits 0 render --out good

# Something else has a frame's name. It is neither opened nor replaced.
for kind in folder pipe socket device circle; do
  rm -rf out
  cp -r good out
  frame=out/linear/fall_00001.exr
  rm $frame
  case $kind in
    folder) mkdir $frame ;;
    pipe) mkfifo $frame ;;
    socket) python3 -c "import socket; socket.socket(socket.AF_UNIX).bind('$frame')" ;;
    device) ln -s /dev/full $frame ;;
    circle) ln -s fall_00001.exr $frame ;;
  esac
  before=$(stat -c '%F %i' $frame)
  for verb in render grade; do
    exits 2 timeout 20 "$DOMEFALL" $verb fall.yaml --frames 0-2 --out out
    says "^$frame: "
  done
  exits 2 render --out out --replace
  [ "$(stat -c '%F %i' $frame)" = "$before" ] || fail "a $kind was replaced"
done
# A link is followed; one that leads nowhere may lead somewhere on another machine.
rm -rf out
cp -r good out
mv out/graded/fall_00002.png elsewhere.png
ln -s ../../elsewhere.png out/graded/fall_00002.png
exits 0 render --out out
says '^0 frames made'
rm elsewhere.png
exits 75 render --out out
says '^out/graded/fall_00002.png: a link that leads nowhere'

# A header that would have a decoder ask for 21 GB is a damaged frame like any other.
rm -rf out
cp -r good out
python3 - out/linear/fall_00001.exr <<'END'
import struct
import sys
with open(sys.argv[1], "r+b") as file:
    exr = file.read()
    for window in (b"dataWindow\0box2i\0", b"displayWindow\0box2i\0"):
        file.seek(exr.index(window) + len(window) + 4)
        file.write(struct.pack("<4i", 0, 0, 59999, 59999))
END
rm out/graded/fall_0000[12].png
exits 75 "$DOMEFALL" grade fall.yaml --frames 0-2 --out out
says 'fall_00001.exr: 1 frame was not graded: 1\.'
[ -f out/graded/fall_00002.png ] || fail "what is there was not graded"
exits 0 render --out out
says '^1 frames made, 2 already there'
same_frames good out

# The path leads through a file; or it is a folder that is not there now, or not for us.
touch file
exits 2 render --out file/below
says '^file/below/linear: '
exits 2 render --out "$(printf 'x%.0s' {1..300})"
ln -s nowhere-yet absent
exits 75 render --out absent/below
says '^absent/below/linear: the folder cannot be made: absent is a link that leads nowhere$'
exits 75 render --out absent
says '^absent/linear: the folder cannot be made: absent is a link that leads nowhere$'
if [ "$(id -u)" -eq 0 ] && setpriv --reuid=65534 --clear-groups true 2>/dev/null; then
  as_nobody() { setpriv --reuid=65534 --clear-groups "$@"; }
elif [ "$(id -u)" -ne 0 ]; then
  as_nobody() { "$@"; }
else
  as_nobody() { return 77; }
fi
# The build may lie where that user cannot look.
cmake --install "$(dirname "$DOMEFALL")" --prefix "$folder/installed" >/dev/null
chmod -R a+rX installed
program=$folder/installed/bin/domefall
if as_nobody "$program" --version >/dev/null 2>&1; then
  mkdir -m 755 ours
  chmod 555 ours
  exits 75 as_nobody "$program" render fall.yaml --frames 0 --out ours
  says '^ours/linear: the folder cannot be made: Permission denied'
  rm -rf out
  cp -r good out
  chmod 0 out/linear/fall_00001.exr
  exits 75 as_nobody "$program" render fall.yaml --frames 0-2 --out out
  says '^out/linear/fall_00001.exr: Permission denied'
fi

# It vanishes in the middle of the run, or is moved.
for fault in 'rm -rf gone' 'mv gone moved'; do
  rm -rf gone moved
  "$DOMEFALL" render fall.yaml --size 512 --out gone 2>gone.log &
  until [ -e gone/graded/fall_00001.png ]; do sleep 0.01; done
  until $fault 2>/dev/null; do :; done
  code=0
  wait $! || code=$?
  [ "$code" -eq 75 ] || fail "$fault: exit code $code: $(cat gone.log)"
  grep -qE '^gone/(linear|graded)/fall_000[0-9]+\.(exr|png): No such file or directory$' gone.log ||
    fail "$fault: $(cat gone.log)"
done
