#!/usr/bin/env bash
# The layers of scene-linear files, put together again by another program.
source "$(dirname "$0")/common.bash"
ln -s "$DOMEFALL_SOURCE"/shows/* .

# layered SHOW OUT OUTPUT...: a shipped show whose scene-linear files have layers.
layered() {
  sed '/^output:/d' "$1" >"$2"
  printf 'output: {graded: none, name: f, layers: [titles, sky, stars, disc, bodies, glare]%s}\n' "$3" >>"$2"
}

# off_by FILE: by how much the layers, put together by the formula of docs/compositing.md, are off
# the picture at most, as a part of it.
off_by() {
  local layer sum=()
  for layer in stars disc bodies glare; do
    sum+=("$1" --ch "$layer.R,$layer.G,$layer.B" --chnames 'r,g,b' --add)
  done
  oiiotool "$1" --ch sky.R,sky.G,sky.B --chnames r,g,b "${sum[@]}" \
    "$1" --ch titles.A,titles.A,titles.A --chnames r,g,b --mulc -1 --addc 1 --mul \
    "$1" --ch titles.R,titles.G,titles.B --chnames r,g,b --add \
    "$1" --ch R,G,B --chnames r,g,b --sub --abs \
    "$1" --ch R,G,B --chnames r,g,b --addc 0.001 --div -d float -o off.exr
  most off.exr
}
# most FILE: the largest value of its channels.
most() { oiiotool --stats "$1" | awk '/Stats Max/ { for (k = 3; k <= NF; ++k) if ($k + 0 > most) most = $k + 0; print most }'; }

# Frames of every shipped show, those of the demo among them.  Halves round by 1/2048 of themselves,
# once for the picture and once for each layer.
for show in "$DOMEFALL_SOURCE"/shows/*.yaml; do
  name=$(basename "$show" .yaml)
  layered "$show" "layers_of_$name.yaml" ""
  count=$("$DOMEFALL" states "layers_of_$name.yaml" | grep -c '^[0-9]')
  size=96
  "$DOMEFALL" render "layers_of_$name.yaml" --size $size --dry-run >stdout 2>&1 || size=96x54
  exits 0 "$DOMEFALL" render "layers_of_$name.yaml" --size $size --out "out_$name" \
    --frames "$((count * 2 / 5))"
  for file in "out_$name"/linear/*.exr; do
    off=$(off_by "$file")
    awk -v off="$off" 'BEGIN { exit !(off < 0.003) }' || fail "$file is off by $off"
  done
done

# The picture is that of a frame without layers, whose key is another.
frame=$(find out_disc/linear -name '*.exr' | sort | head -1)
number=$((10#$(basename "$frame" .exr | cut -c3-)))
cp layers_of_disc.yaml kept.yaml
sed -i 's/layers: \[[^]]*\]/owner: us/' layers_of_disc.yaml
exits 0 "$DOMEFALL" render layers_of_disc.yaml --size 96 --frames "$number" --out plain
oiiotool "$frame" --ch R,G,B -o picture.exr
same_pixels picture.exr "plain/linear/$(basename "$frame")" || fail "layers change the picture"
mv kept.yaml layers_of_disc.yaml
exits 0 "$DOMEFALL" render layers_of_disc.yaml --size 96 --frames "$number" --out plain
says '^1 frames made'
exits 0 "$DOMEFALL" render layers_of_disc.yaml --size 96 --frames "$number" --out plain
says '^0 frames made'

# With files of their own, layers are the same pixels under the names of colours. A file that is
# missing is made again, with its frame.
sed 's/layers: /layer_files: true, &/' layers_of_disc.yaml >apart.yaml
exits 0 "$DOMEFALL" render apart.yaml --size 96 --frames "$number" --out apart
of_number=$(basename "$frame")
for layer in sky stars disc bodies glare titles; do
  oiiotool "$frame" --ch "$layer.R,$layer.G,$layer.B" -o picture.exr
  oiiotool "apart/layers/$layer/$of_number" --ch R,G,B -o one.exr
  same_pixels picture.exr one.exr || fail "the file of $layer has other pixels"
done
oiiotool "$frame" --ch disc.A -o picture.exr
oiiotool "apart/layers/disc/$of_number" --ch A -o one.exr
same_pixels picture.exr one.exr || fail "the file of the disc has another alpha"
! oiiotool --info -v "apart/linear/$of_number" | grep -q 'disc[.]' || fail "the frame has its layers twice"
cp -r apart whole
rm "apart/layers/disc/$of_number"
exits 0 "$DOMEFALL" render apart.yaml --size 96 --frames "$number" --out apart --dry-run
[ "$(cat stdout)" = "$number" ] || fail "a layer's missing file makes $(cat stdout) again"
exits 0 "$DOMEFALL" render apart.yaml --size 96 --frames "$number" --out apart
says '^1 frames made'
same_frames apart/layers/disc whole/layers/disc
sed 's/layers: \[[^]]*\]/layers: [disc]/' apart.yaml >fewer.yaml
mkdir fewer
mv fewer.yaml fewer/apart.yaml
touch apart/layers/sky/notes.txt
exits 0 "$DOMEFALL" render fewer/apart.yaml --size 96 --frames "$number" --out apart
says '^apart: 1 file is not this show.s, and is left alone: layers/sky/notes.txt; 5 files are of layers that the show no longer asks for, and are left alone: layers/bodies/'

# Graded files may have an alpha, of the dome's circle.
for kind in png16 png8 tiff16 tiff8; do
  printf 'size: 96\ntimeline: [{duration_s: 1}]\noutput: {linear: none, graded: %s' "$kind" >plain.yaml
  sed 's/$/, graded_alpha: true}/;1,2s/, graded_alpha: true}//' plain.yaml >alpha.yaml
  echo '}' >>plain.yaml
  for show in plain alpha; do exits 0 "$DOMEFALL" render $show.yaml --frames 0 --out "$kind"; done
  oiiotool "$kind"/graded/alpha_00000.* --ch R,G,B -o colours.tif
  oiiotool "$kind"/graded/plain_00000.* -o plain.tif
  same_pixels colours.tif plain.tif || fail "an alpha changes the colours of $kind"
  oiiotool "$kind"/graded/alpha_00000.* --ch A -d float -o alpha.exr
  oiiotool "$frame" --ch A -d float -o circle.exr
  same_pixels alpha.exr circle.exr || fail "the alpha of $kind is not that of the frame"
done

# Channels in the order in which other programs list them; alpha is 1 in the dome alone.
exits 0 oiiotool --info -v "$frame"
grep -q 'channel list: R.*G.*B.*A.*bodies.R.*bodies.A.*disc.R.*disc.A.*glare.R.*sky.R.*stars.R.*titles.R.*titles.A' stdout ||
  fail "channels: $(grep 'channel list' stdout)"

# It is graded from the file as it would be at once.
sed 's/graded: none/graded: png16/' layers_of_disc.yaml >graded.yaml
exits 0 "$DOMEFALL" render graded.yaml --size 96 --frames "$number" --out at_once
mkdir -p later
cp -r at_once/linear later/
exits 0 "$DOMEFALL" grade graded.yaml --size 96 --frames "$number" --out later
same_frames at_once/graded later/graded

# Floats have layers of floats.
layered disc.yaml floats.yaml ', linear: float, compression: piz'
exits 0 "$DOMEFALL" render floats.yaml --size 64 --frames "$number" --out floats
off=$(off_by "floats/linear/$(basename "$frame")")
awk -v off="$off" 'BEGIN { exit !(off < 1e-3) }' || fail "floats are off by $off"

# A disc that a compositor makes a third darker is the one that a keyframe makes a third darker, where
# its glare is left to the compositor, too.
sed '/^glare:/d; 1i glare: {share: 0}' disc.yaml >sharp.yaml
layered sharp.yaml sharp_layers.yaml ''
exits 0 "$DOMEFALL" render sharp_layers.yaml --size 96 --frames "$number" --out sharp
frame=sharp/linear/$(basename "$frame")
sed '/^output:/d; 0,/{at_s: 0,/s//{at_s: 0, disc: {luminance_cd_m2: 6.6666666667e-3},/' sharp.yaml >dimmed.yaml
printf 'output: {graded: none, name: f}\n' >>dimmed.yaml
exits 0 "$DOMEFALL" render dimmed.yaml --size 96 --frames "$number" --out dimmed
dimmed=dimmed/linear/$(basename "$frame")
oiiotool "$frame" --ch R,G,B --chnames r,g,b "$frame" --ch disc.R,disc.G,disc.B --chnames r,g,b --divc 3 --sub \
  "$dimmed" --ch R,G,B --chnames r,g,b --sub --abs "$dimmed" --ch R,G,B --chnames r,g,b --addc 0.001 --div \
  -d float -o off.exr
oiiotool "$frame" --ch R,G,B "$dimmed" --ch R,G,B --sub --abs -o change.exr
awk -v off="$(most off.exr)" -v change="$(most change.exr)" 'BEGIN { exit !(off < 0.003 && change > 0.1) }' ||
  fail "a dimmed disc is off by $(most off.exr), of a change of $(most change.exr)"

# Mattes and identities: each body's matte is found again by its name, from the manifest.
sed '/^output:/d; s/^titles:/&\n  - {text: "Two: \\"stars\\"", at_s: 40, duration_s: 8, elevation_deg: 15, height_deg: 5, shadow: 0.5}/' \
  beacon.yaml >data.yaml
printf 'output: {graded: none, name: f, data: [mattes, cryptomatte, lens]}\n' >>data.yaml
exits 0 "$DOMEFALL" render data.yaml --size 128 --frames 1325 --out data
file=data/linear/f_01325.exr
# id_of NAME: the number of an object, out of the file's manifest.
id_of() {
  oiiotool --info -v "$file" | python3 -c '
import json, re, struct, sys
text = sys.stdin.read()
manifest = json.loads(re.search(r"cryptomatte/\w{7}/manifest: \"(.*)\"\n", text)[1])
print(repr(struct.unpack(">f", bytes.fromhex(manifest[sys.argv[1]]))[0]))' "$1"
}
# extract NAME: what the ranks say of an object, as extracted.exr.
extract() {
  local id rank ranks=()
  id=$(id_of "$1")
  for rank in 00.R:00.G 00.B:00.A 01.R:01.G 01.B:01.A; do
    ranks+=("$file" --ch "CryptoObject${rank%:*}" --divc "$id" --subc 1 --abs --mulc 1e6 --clamp:min=0:max=1
      --mulc -1 --addc 1 "$file" --ch "CryptoObject${rank#*:}" --mul)
    [ "${#ranks[@]}" -lt 20 ] || ranks+=(--add)
  done
  oiiotool "${ranks[@]}" -o extracted.exr
}
for body in first:body_1 second:body_2; do
  extract "${body%:*}"
  oiiotool extracted.exr "$file" --ch "${body#*:}.A" --sub --abs -o off.exr
  awk -v off="$(most off.exr)" -v most="$(most extracted.exr)" 'BEGIN { exit !(off < 1e-6 && most > 0.5) }' ||
    fail "the matte of ${body%:*} is off by $(most off.exr) of $(most extracted.exr)"
done
extract 'Two: "stars"'
awk -v most="$(most extracted.exr)" 'BEGIN { exit !(most > 0.3) }' || fail "no matte of the title: $(most extracted.exr)"

# The numbers of the lens are those of a lens map, and a disc's are those of the probe.
exits 0 "$DOMEFALL" render data.yaml --size 128 --frames 1325 --lens-map --out data
channels=sky.x,sky.y,sky.z,st.s,st.t,light.one_plus_z,light.amplification,gas.radius
oiiotool "$file" --ch $channels -o of_frame.exr
oiiotool data/lens/f_01325.exr --ch $channels -o of_map.exr
same_pixels of_frame.exr of_map.exr || fail "frame and lens map differ"

# Wrong lists are refused with their place.
refuses() {
  printf 'size: 64\ntimeline: [{duration_s: 1}]\noutput: {%s}\n' "$1" >wrong.yaml
  exits 2 "$DOMEFALL" check wrong.yaml
  says "wrong.yaml:3:[0-9]+: $2"
}
refuses 'layers: [sky, star]' "output.layers\[2\] must be sky.*'star'; did you mean stars"
refuses 'layers: [sky, sky]' 'output.layers\[2\] is listed twice: sky'
refuses 'layers: sky' 'output.layers'
refuses 'linear: none, layers: [sky]' 'output.layers are in scene-linear files'
refuses 'layer_files: true' 'output.layer_files is for layers, of which none'
refuses 'graded: jpeg, graded_alpha: true' 'output.graded_alpha is for PNG and TIFF'
refuses 'data: [lens, matte]' "output.data\[2\] must be lens.*'matte'; did you mean mattes"
refuses 'linear: none, data: [lens]' 'output.data are in scene-linear files'

# The gizmo for Nuke, by its grammar alone: what its statements leave on the stack is one picture, of
# which every layer is a part.
python3 - "$DOMEFALL_SOURCE/docs/domefall_layers.gizmo" <<'END'
import re, sys
text = re.sub(r"^#.*\n", "", open(sys.argv[1]).read(), flags=re.M)
statement = re.compile(r"\s*(?:set (?P<set>\w+) \[stack 0\]|push \$(?P<push>\w+)|(?P<end>end_group)|(?P<node>\w+) \{)")
stack, kept, inputs, at = [], {}, {}, 0
while text[at:].strip():
    found = statement.match(text, at)
    assert found, text[at:at + 60]
    at = found.end()
    if found["set"]:
        kept[found["set"]] = stack[-1]
    elif found["push"]:
        stack.append(kept[found["push"]])
    elif found["node"]:
        begin, depth = at, 1
        while depth:
            depth += {"{": 1, "}": -1}.get(text[at], 0)
            at += 1
        if found["node"] == "Gizmo":
            continue
        knobs = text[begin:at - 1]
        name, count = re.search(r"name (\w+)", knobs)[1], int((re.search(r"inputs (\d)", knobs) or [0, 1])[1])
        inputs[name] = (found["node"], knobs, [stack.pop() for _ in range(count)])
        stack.append(name)
def parts(name):
    node, knobs, behind = inputs[name]
    own = {re.search(r"in (\w+)", knobs)[1]} if node == "Shuffle" else set()
    return own.union(*(parts(one) for one in behind))
assert parts("Output1") == {"sky", "stars", "disc", "bodies", "glare", "titles"}, parts("Output1")
over = next(node for node in inputs.values() if "operation over" in node[1])
assert parts(over[2][1]) == {"titles"}, over
END
