#!/usr/bin/env bash
# Names that would steer a terminal, end a line of a list or be taken for an option: they are refused
# where they would be written or handed on, and told in words that a terminal shows as they are.
source "$(dirname "$0")/common.bash"
write_flat_show fall.yaml 32 1
# tame FILE...: nothing in it steers a terminal.
tame() {
  ! LC_ALL=C grep -qP '[\x01-\x08\x0b-\x1f\x7f]|\xc2[\x80-\x9f]|\xe2\x80[\xa8-\xae]' "$@" ||
    fail "this steers a terminal: $(cat -v "$@")"
}
exits 0 "$DOMEFALL" render fall.yaml --out made

# In what is typed, whatever it is for.
# refused SPELT NAME ARGUMENT...: with the name as the last argument.
refused() {
  local spelt=$1 name=$2
  shift 2
  exits 2 "$DOMEFALL" "$@" "$name"
  says "a\\\\${spelt}b: has the control character \\\\${spelt}, "
  tame stderr
  [ ! -e "$name" ] || fail "something was made"
}
for what in check 'render fall.yaml --out' 'grade fall.yaml --out' 'movie fall.yaml --preset review --out' \
  'movie fall.yaml --preset review --audio' 'deliver fall.yaml --from made --out' 'deliver --check' \
  'deliver fall.yaml --from made --out d --name' 'sheet fall.yaml --from made --out' 'states fall.yaml --plot' \
  'farm submit fall.yaml --engine list --out' 'farm submit fall.yaml --engine list --deliver' \
  'farm submit fall.yaml --engine slurm --dry-run -- --comment' 'farm status' 'stars info' 'sky info' nosuch; do
  read -ra words <<<"$what"
  refused n $'a\nb' "${words[@]}"
done
refused x1B $'a\eb' check
refused u2028 $'a\xe2\x80\xa8b' check
exits 2 "$DOMEFALL" render fall.yaml $'--out=a\nb'
says '^--out=a\\nb: has the control character'
# Others are shown as what they are: marks that turn the direction of writing, and lone bytes.
exits 2 "$DOMEFALL" check fall.yaml --nosuch=$'\u202e'
says 'nosuch=\\u202E'
exits 2 "$DOMEFALL" check $'no\u202elmay.show'
says '^no\\u202Elmay.show: '
exits 2 "$DOMEFALL" check $'latin\xe9\x9b'
says '^latin\\xE9\\x9B: '

# In the working folder: each line of a list is handed to a shell.
odd=$'x\ntouch pwned #'
mkdir "$odd"
cp fall.yaml "$odd"
for engine in list openjd flamenco local slurm; do
  (
    cd "$odd"
    for dry in "" --dry-run; do
      exits 2 env PATH=/usr/bin:/bin "$DOMEFALL" farm submit fall.yaml --engine "$engine" --out o ${dry:+"$dry"}
      says '/x\\ntouch pwned #/.*: has the control character \\n, '
      [ ! -e o ] || fail "a folder was made"
    done
  )
done

# In a show, whose texts may be escaped.
while read -r line; do
  sed "/^title/d; \$a $line" fall.yaml >odd.yaml
  exits 2 "$DOMEFALL" check odd.yaml
  says '^odd.yaml:6:[0-9]+: .* control characters'
  tame stderr
done <<'END'
titles: [{text: "a\\x9b31mb", at_s: 0, duration_s: 1}]
titles: [{text: "a\\eb", at_s: 0, duration_s: 1}]
title: "a\\Lb"
title: "a\\nb"
END
for name in n x9b L P e x7f; do
  sed "s/linear: none/&, name: \"a\\\\${name}b\"/" fall.yaml >odd.yaml
  exits 2 "$DOMEFALL" check odd.yaml
  says '^odd.yaml:5:[0-9]+: output.name must be one line without control characters'
  tame stderr
done
sed 's/^title:.*/title: "A fall \\u202Egnp.exe"/' fall.yaml >odd.yaml
exits 0 "$DOMEFALL" check odd.yaml
grep -qxF 'title        A fall \u202Egnp.exe' stdout || fail "$(cat stdout)"
tame stdout

# Among the frames, and in a delivery.
stray=$'made/graded/stray\e]0;x\a\nframe 7: done'
echo >"$stray"
exits 0 "$DOMEFALL" render fall.yaml --out made
says 'left alone: graded/stray\\x1B\]0;x\\x07\\nframe 7: done$'
tame stderr
exits 0 "$DOMEFALL" farm status made --show fall.yaml
grep -qF 'graded/stray\x1B]0;x\x07\nframe 7: done' stdout || fail "$(cat stdout)"
tame stdout
exits 1 "$DOMEFALL" farm verify made --show fall.yaml
tame stdout stderr
rm "$stray"
exits 0 "$DOMEFALL" deliver fall.yaml --from made --out delivered
for stray in $'README.txt\nmetadata.json' $'\e[31mred' $'-n \\c'; do
  echo >"delivered/$stray"
  exits 2 "$DOMEFALL" deliver --check delivered
  says 'not of this delivery: '
  tame stderr
  exits 1 sh delivered/verify.sh
  tame stdout stderr
  rm "delivered/$stray"
done
exits 0 sh delivered/verify.sh

# What a shell, sbatch and our own options would take for something else is taken as it is.
for name in -x '--wrap=touch pwned' 'a,b' '%j' "it's \$(touch pwned)" '{}' '~' 'a;b' '#'; do
  mkdir -p "./$name"
  cp fall.yaml "./$name/$name.yaml"
  exits 0 "$DOMEFALL" farm submit "./$name/$name.yaml" --engine list --out "./$name/o" --chunk 2
  cp stdout list
  xargs -d '\n' -n 1 sh -c <list 2>log || fail "$(cat log)"
  [ "$(find "./$name/o/graded" -name '*.png' | wc -l)" -eq 4 ] || fail "$name: $(cat list)"
done
[ -z "$(find . -name pwned)" ] || fail "a name was run as a command"
