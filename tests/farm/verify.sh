#!/usr/bin/env bash
# `domefall farm verify` and `status` tell each kind of damage with its frame's number, --repair mends it, and
# what a changed show costs is told before anything is made.
source "$(dirname "$0")/../cli/common.bash"

# The first frame of the fade is black, as the show says.
cat >fall.yaml <<'END'
title: A fall to be verified
frames_per_second: 10
size: 64
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {background: grid, stars: none}}
timeline:
  - {duration_s: 1, fade_in_s: 0.5, trajectory: {type: infall, from_r: 30, to_r: 4}}
  - {duration_s: 1, trajectory: {type: infall, from_r: 4, to_r: 0.5}}
END
mkdir others
sed 's/^title:.*/title: Another/' fall.yaml >others/fall.yaml
domefall() { "$DOMEFALL" "$@"; }
# has FIELD VALUE: of the JSON that was printed last, where it is a text.
has() { grep -qF "\"$1\": \"$2\"" stdout || fail "$1 is not $2: $(cat stdout)"; }
# foreign FILE...: these are listed, and no others.
foreign() {
  local list
  list=$(sed -n '/"foreign": \[/,/\]/s/^ *"\([^"]*\)",\?$/\1/p' stdout | paste -sd' ')
  [ "$list" = "$*" ] || fail "foreign: $list"
}
linear() { printf 'out/linear/fall_%05d.exr' "$1"; }
graded() { printf 'out/graded/fall_%05d.png' "$1"; }

# ---- a whole folder, with a plan and without one ----
mkdir -p out/farm/log
exits 2 domefall farm verify out
says 'farm: there is no plan; name the show by --show'
exits 75 domefall farm verify nowhere --show fall.yaml
exits 2 domefall farm verify fall.yaml --show fall.yaml
exits 0 domefall render fall.yaml --out out
exits 0 domefall farm verify out --show fall.yaml
# A plan of all frames, as for an engine whose job is 4.
exits 0 domefall farm submit fall.yaml --engine list --out planned --size 64 --chunk 10
sed -i 's/"job": ""/"job": "4"/' planned/farm/plan_*.json
mv planned/farm/plan_*.json out/farm
exits 0 domefall farm verify out --json
grep -q '"good": 20,' stdout || fail "$(cat stdout)"
has to_make ''
has black ''
exits 0 domefall farm status out --json
grep -q '"done": 20,' stdout || fail "$(cat stdout)"
exits 0 domefall render others/fall.yaml --out others/out
cp -r out whole

# ---- each damage is told ----
truncate -s -7 "$(linear 2)"
cat >flip.py <<'END'
import sys
with open(sys.argv[1], "r+b") as file:
    file.seek(-60, 2)
    byte = file.read(1)[0]
    file.seek(-60, 2)
    file.write(bytes([byte ^ 16]))
END
python3 flip.py "$(graded 3)"
cp others/out/linear/fall_00005.exr "$(linear 5)"
rm "$(graded 7)"
rm "$(linear 8)"
mkdir "$(linear 8)" # root may read everything but a folder
: >out/linear/fall_00020.exr
echo notes >out/graded/notes.txt
# A frame of the right key and digest that is black, made by another program.
cat >blacken.py <<'END'
import ctypes, struct, sys, zlib

class Hash(ctypes.Structure):
    _fields_ = [("low", ctypes.c_uint64), ("high", ctypes.c_uint64)]

xxhash = ctypes.CDLL("libxxhash.so.0")
xxhash.XXH3_128bits.restype = Hash
xxhash.XXH3_128bits.argtypes = [ctypes.c_char_p, ctypes.c_size_t]

def sealed(chunks):
    """The file, with the digest of its bytes in its description."""
    def text(digest, checksum):
        data = b"\x89PNG\r\n\x1a\n"
        for kind, body in chunks:
            crc = struct.pack(">I", zlib.crc32(kind + body))
            if kind == b"tEXt":
                at = body.index(b"digest: ") + 8
                body = body[:at] + digest + body[at + 32:]
                crc = checksum or struct.pack(">I", zlib.crc32(kind + body))
            data += struct.pack(">I", len(body)) + kind + body + crc
        return data
    blank = text(b"0" * 32, b"0" * 4)
    found = xxhash.XXH3_128bits(blank, len(blank))
    return text(b"%016x%016x" % (found.high, found.low), None)

path = sys.argv[1]
data, at, chunks = open(path, "rb").read(), 8, []
while at < len(data):
    size, kind = struct.unpack(">I4s", data[at:at + 8])
    chunks.append((kind, data[at + 8:at + 8 + size]))
    at += 12 + size
assert sealed(chunks) == data, "the digest is not what this test takes it for"
width, height, bits = struct.unpack(">IIB", dict(chunks)[b"IHDR"][:9])
black = zlib.compress((b"\0" + bytes(width * 3 * bits // 8)) * height)
plain = [c for c in chunks if c[0] != b"IDAT"]
end = [c[0] for c in plain].index(b"IEND")
open(path, "wb").write(sealed(plain[:end] + [(b"IDAT", black)] + plain[end:]))
END
cp "$(graded 11)" black.png
python3 blacken.py black.png
cp black.png "$(graded 11)"

exits 75 domefall farm verify out --json
grep -q '"good": 14,' stdout || fail "$(cat stdout)"
has damaged '2-3'
has others 5
has missing 7
has unreadable 8
has stale ''
has black 11
has unlike_manifest 11
has to_make '2-3,5,7,11'
foreign graded/notes.txt linear/fall_00005.exr linear/fall_00020.exr
exits 75 domefall farm verify out
says '1 frame cannot be read'
grep -q 'fall_00008.exr' stdout || fail "what cannot be read is not named"
# Without the manifests, what is seen on the frames is the same.
mv out/farm/manifest manifest
exits 75 domefall farm verify out --json
has black 11
has unlike_manifest ''
has to_make '2-3,5,7,11'
mv manifest out/farm/manifest

# ---- status sees what beginnings, lengths and names tell, and the last line of a log ----
printf 'rendering\nframe 7: no space left on device\n\n' >out/farm/log/job_4_0.log
exits 0 domefall farm status out --json
# The black frame has not the length that its writer noted.
has damaged 2,11
has missing 7
has others 5
grep -q '"last_line": "frame 7: no space left on device"' stdout || fail "the log's line is not told"
exits 0 domefall farm status out
grep -q 'round 0, task 0 lacks 2,5,7; .*job_4_0.log: frame 7: no space' stdout || fail "$(cat stdout)"

# ---- --repair ----
rmdir "$(linear 8)"
# Foreign files are left and told, and do not keep a movie waiting that follows a repair.
exits 0 domefall farm verify out --repair --json
grep -q '"good": 20,' stdout || fail "$(cat stdout)"
has to_make ''
foreign graded/notes.txt linear/fall_00020.exr
exits 1 domefall farm verify out
says '2 files among them not this show'
rm out/graded/notes.txt out/linear/fall_00020.exr
for kind in linear graded; do same_frames whole/$kind out/$kind; done
exits 0 domefall farm verify out
# Nothing is left to do, and nothing is touched.
find out -newer stdout -type f >touched
exits 0 domefall farm verify out --repair
find out -newer touched -type f | grep . && fail "good frames were made again"
# A file without rights is told, to whoever is held to them, and made anew.
if [ "$(id -u)" -ne 0 ]; then
  chmod 0 "$(linear 9)"
  exits 75 domefall farm verify out
  exits 0 domefall farm verify out --repair
  same_frames whole/linear out/linear
fi
# What is no file is told and left, and all else is made again. A link stays, and leads to the new frame.
mkdir elsewhere
for k in 1 2 3; do
  mv "$(linear $k)" "elsewhere/$k.exr"
  ln -s "../../elsewhere/$k.exr" "$(linear $k)"
done
exits 0 domefall farm verify out
truncate -s -7 elsewhere/1.exr
rm elsewhere/3.exr
cp black.png elsewhere/black.png
rm "$(graded 11)" "$(linear 4)" "$(graded 5)" "$(linear 6)" "$(linear 7)"
ln -s "$PWD/elsewhere/black.png" "$(graded 11)"
mkdir "$(linear 4)"
mkfifo "$(graded 5)"
ln -s fall_00006.exr "$(linear 6)"
exits 75 domefall farm verify out --repair --json
has unreadable 3-6
has to_make ''
grep -q '"good": 16,' stdout || fail "$(cat stdout)"
exits 75 domefall farm verify out
says '4 frames cannot be read$'
for k in 3 4 5 6; do grep -q "^    $k: .*fall_0000$k" stdout || fail "frame $k is not told: $(cat stdout)"; done
if [ ! -d "$(linear 4)" ] || [ ! -p "$(graded 5)" ]; then fail "what was no file was replaced"; fi
for link in "$(linear 1)" "$(linear 2)" "$(linear 3)" "$(graded 11)"; do
  [ -L "$link" ] || fail "the link $link was replaced"
done
cmp elsewhere/1.exr whole/linear/fall_00001.exr
cmp elsewhere/black.png whole/graded/fall_00011.png
rmdir "$(linear 4)"
rm "$(graded 5)" "$(linear 6)" "$(linear 3)"
exits 0 domefall farm verify out --repair
# So it is for render and grade, which follow a link to what is to be made anew.
rm "$(linear 1)" "$(linear 2)" "$(graded 11)"
cp whole/linear/fall_0000[12].exr out/linear
cp whole/graded/fall_00011.png out/graded
for verb in render grade; do
  rm elsewhere/*
  for k in 1 2; do
    echo old >elsewhere/$k.png
    ln -sf "../../elsewhere/$k.png" "$(graded $k)"
  done
  exits 0 domefall $verb fall.yaml --out out --replace
  for k in 1 2; do
    [ -L "$(graded $k)" ] || fail "$verb replaced a link"
    cmp elsewhere/$k.png "whole/graded/fall_0000$k.png"
  done
done
[ -z "$(find elsewhere out -name '.*.tmp')" ] || fail "left: $(find elsewhere out -name '.*.tmp')"
rm "$(graded 1)" "$(graded 2)"
cp whole/graded/fall_0000[12].png out/graded
# Another show's folder is not made this one's.
exits 2 domefall farm verify others/out --show fall.yaml --repair
says 'belongs to'
rm others/out/fall.json
exits 2 domefall farm verify others/out --show fall.yaml --repair
says 'no frame is of this show, and 20 are of another'
exits 1 domefall farm verify out --show others/fall.yaml
same_frames whole/linear out/linear

# ---- a changed show ----
cp fall.yaml kept.yaml
sed -i 's/to_r: 0.5/to_r: 0.6/' fall.yaml
exits 0 domefall farm status out
grep -qx 'segment 2: 9 frames will be made again' stdout || fail "$(cat stdout)"
exits 1 domefall farm verify out --json
has stale '11-19'
exits 0 domefall render fall.yaml --frames 3-5,9 --out out
says '0 frames made, 4 already there'
cp kept.yaml fall.yaml
exits 0 domefall farm verify out

# ---- --watch, on a terminal and into a pipe ----
rm "$(linear 4)"
cat >watch.py <<'END'
import os, pty, signal, subprocess, sys
command = [os.environ["DOMEFALL"], "farm", "status", "out", "--watch"]
# Of a job in the background, signals to interrupt it are ignored by what it starts, too.
signal.signal(signal.SIGINT, signal.default_int_handler)

def begun(out):
    return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.PIPE)

terminal, side = pty.openpty()
reader, writer = os.pipe()
watchers = [(begun(side), terminal), (begun(writer), reader)]
os.close(side), os.close(writer)
said = []
for process, out in watchers:
    text = b""
    while text.count(b"19 of 20 frames are done") < 2:
        piece = os.read(out, 4096)
        assert piece, (process.wait(), process.stderr.read())
        text += piece
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=60) == 130, process.returncode
    assert process.stderr.read() == b""
    said.append(text)
assert said[0].startswith(b"\x1b[H\x1b[J") and said[0].count(b"\x1b[H") >= 2, said[0]
assert b"\x1b" not in said[1] and b"\r" not in said[1], said[1]
END
python3 watch.py || fail "see above"
exits 0 domefall render fall.yaml --out out
exits 0 domefall farm status out --watch # all is done: there is nothing to wait for
