#!/usr/bin/env bash
# A folder belongs to a show and a size: what a run finds there, what it says of it, what it refuses.
source "$(dirname "$0")/common.bash"
write_show fall.yaml
run() { "$DOMEFALL" render "$@"; }
# untouched FOLDER: nothing in it was written since it was dated back.
date_back() { find "$1" -type f -exec touch -d 2001-01-01 {} +; }
untouched() { [ -z "$(find "$1" -newermt 2002-01-01 -type f)" ] || fail "$1 was written to"; }

exits 0 run fall.yaml --frames 8-15 --out out
diff out/fall.json - <<'END' || fail "the record is another"
{
  "show": "fall",
  "title": "A short fall",
  "projection": "domemaster",
  "width": 96,
  "height": 96,
  "frames": 24,
  "frames_per_second": 12.0,
  "linear": "exr",
  "graded": "png",
  "name": "fall",
  "start": 0,
  "digits": 5,
  "per_folder": 0
}
END
cp -r out kept
date_back out

# Another size, another show under the same name, another projection.
refused() { # refused NUMBER WHAT show and options
  exits 2 run "${@:3}" --out out
  says "^out: $1 good frames? of another size, show or kind would be replaced, such as out/.*\\($2\\)"
  says 'Another --out leaves them alone, --replace replaces them$'
}
refused 8 '96 x 96 pixels' fall.yaml --size 64
refused 1 '96 x 96 pixels' fall.yaml --size 64 --frames 9
mkdir -p other flat none
sed 's/title: .*/title: A long fall/' fall.yaml >other/fall.yaml
refused 8 "of the show 'A short fall'" other/fall.yaml
sed 's/size: 96/size: [96, 96]\ncamera: {projection: stereographic, fov_deg: 100}/' fall.yaml >flat/fall.yaml
refused 8 'of the projection domemaster' flat/fall.yaml
exits 2 "$DOMEFALL" grade fall.yaml --size 64 --out out
says '^out: 8 good frames'
# Frames that are not there yet would make a mixture, which the record tells.
exits 2 run fall.yaml --size 64 --frames 0-3 --out out
says "^out/fall.json: the folder belongs to 'A short fall', domemaster of 96 x 96 pixels"
exits 2 run fall.yaml --size 64 --frames 0-3 --out out --dry-run
# Without a record, or with a broken one, the frames themselves are asked.
rm out/fall.json
refused 8 '96 x 96 pixels' fall.yaml --size 64
echo '{"title": 3' >out/fall.json
refused 8 '96 x 96 pixels' fall.yaml --size 64
# An image of another program, or under the name of another kind, is somebody's too.
mkdir -p foreign/linear foreign/graded
oiiotool --create 96x96 3 -d half -o foreign/linear/fall_00003.exr
oiiotool --create 96x96 3 -d uint16 -o foreign/graded/fall_00004.png
cp out/graded/fall_00008.png foreign/linear/fall_00005.exr
cp -r foreign foreign.kept
exits 2 run fall.yaml --out foreign
says "^foreign: 3 good frames .* \\(an image that is not Domefall's\\)"
exits 2 run fall.yaml --frames 5 --out foreign
says '^foreign: 1 good frame .* \(a PNG\)'
same_frames foreign foreign.kept
untouched out/linear
untouched out/graded

# What was asked for is done.
exits 0 run fall.yaml --frames 3-5 --out foreign --replace
says '^3 frames made'
exits 0 run fall.yaml --size 64 --frames 9 --out out --replace
says '^1 frames made'
grep -q '"width": 64' out/fall.json || fail "the record was not renewed"
refused 1 '64 x 64 pixels' fall.yaml
exits 0 run fall.yaml --frames 8-15 --out out --replace
same_frames kept out

# A dry run prints what would be made, makes nothing, and needs no folder.
exits 0 run fall.yaml --frames 6-17 --out out --dry-run
[ "$(cat stdout)" = 6-7,16-17 ] || fail "a dry run printed $(cat stdout)"
same_frames kept out
exits 0 run fall.yaml --out nowhere --dry-run
[ "$(cat stdout)" = 0-23 ] || fail "a dry run printed $(cat stdout)"
[ ! -e nowhere ] || fail "a dry run made a folder"

# What an edit of the show costs is said before it begins, and a damaged frame is not counted.
exits 0 run fall.yaml --out out
says '24 frames made|16 frames made'
if grep -q again stderr; then fail "a frame that was not there is made 'again'"; fi
cp -r out edited
truncate -s -1 edited/linear/fall_00020.exr
sed 's/to_r: 1}/to_r: 0.9}/' fall.yaml >none/fall.yaml
exits 0 run none/fall.yaml --out edited --dry-run
says '^segment 2: 11 frames will be made again$'
sed 's/from_r: 6/from_r: 7/; s/to_r: 1}/to_r: 0.9}/' fall.yaml >none/fall.yaml
exits 0 run none/fall.yaml --frames 4-17 --out edited
says '^segments 1 and 2: 13 frames will be made again$'
{
  cat fall.yaml
  echo 'grade: {view: Star field}'
} >none/fall.yaml
exits 0 "$DOMEFALL" grade none/fall.yaml --frames 0-3 --out out
says '^segment 1: 4 frames will be graded again$'

# A shortened show, another name, another kind: told, and left alone.
sed 's/duration_s: 1, trajectory: {type: infall, from_r: 2.5/duration_s: 0.5, trajectory: {type: infall, from_r: 2.5/' \
  fall.yaml >none/fall.yaml
touch out/linear/notes.txt out/linear/fall_3.exr out/graded/fall_00001.tif
find out/linear out/graded -type f | sort >before
exits 0 run none/fall.yaml --out out
says '^out: 15 files are not this show.s, and are left alone: graded/fall_00001.tif, graded/fall_00018.png, graded/fall_00019.png and 12 more$'
find out/linear out/graded -type f | sort | diff before - || fail "files were deleted"
cp fall.yaml again.yaml
exits 0 run again.yaml --frames 0 --out out
says '^out: 51 files are not this show.s'
if [ ! -e out/again.json ] || [ ! -e out/fall.json ]; then fail "two shows have one record"; fi

# Two shows that call their files alike do not replace each other's.
echo 'output: {name: film}' | cat fall.yaml - >first.yaml
sed 's/to_r: 2.5/to_r: 2.6/; s/from_r: 2.5/from_r: 2.6/' first.yaml >second.yaml
exits 0 run first.yaml --frames 0-1 --out films
date_back films/linear
exits 2 run second.yaml --frames 0-1 --out films
says "^films/first.json: files called film_... belong to another show, first\. Another output.name"
untouched films/linear
exits 0 run first.yaml --frames 0-2 --out films
exits 0 run second.yaml --frames 0-1 --out films --replace

# Of a run over a range, the files of other frames are not looked at.
mkfifo out/linear/fall_00030.exr
rm out/linear/fall_00007.exr
mkfifo out/linear/fall_00007.exr
exits 0 run fall.yaml --frames 8-9 --out out
exits 2 timeout 10 "$DOMEFALL" render fall.yaml --frames 7-9 --out out
says '^out/linear/fall_00007.exr: this is a pipe'

# Workers that begin at once agree on the record.
for k in 0 1 2 3; do run fall.yaml --frames "$k" --out crowd 2>"crowd$k" & done
wait
exits 0 run fall.yaml --frames 0-3 --out crowd
says '^0 frames made, 4 already there'
cmp crowd/fall.json kept/fall.json || fail "the record depends on who wrote it"
