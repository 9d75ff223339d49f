#!/usr/bin/env bash
# A limit on threads or processes, whatever it is: the run is done, or ends with 75 and says why; it
# neither breaks off without a word nor waits for ever.
source "$(dirname "$0")/common.bash"
write_show fall.yaml
sed -i 's/size: 96/size: 16/' fall.yaml
# The build may lie where that user cannot look.
cmake --install "$(dirname "$DOMEFALL")" --prefix "$folder/installed" >/dev/null
chmod -R a+rX installed
chmod 755 "$folder"
program=$folder/installed/bin/domefall
# The limit counts all processes of a user, and none of root's, so that a user is needed who has none.
limited() { # limited COUNT command...
  timeout -k 1 20 prlimit --nproc="$1" setpriv --reuid=54321 --regid=54321 --clear-groups "${@:2}"
}
if [ "$(id -u)" -ne 0 ] || ! limited 100 "$program" --version >/dev/null 2>&1; then
  echo "skipped: needs root, who can become a user without processes"
  exit 77
fi
mkdir -m 777 out

least=0 # with which the run is done
for count in $(seq 1 200); do
  code=0
  limited "$count" "$program" render fall.yaml --frames 0 --threads 2 --out out 2>stderr || code=$?
  if [ "$code" -eq 0 ]; then
    least=$count
    break
  fi
  [ "$code" -eq 75 ] || fail "a limit of $count: exit code $code: $(cat stderr)"
  says 'threads? can be started'
done
[ "$least" -gt 1 ] || fail "no limit was enough, or none was needed"
# All that a run does is done within what it asks for: rendering, both formats, grading again.
for threads in 1 3; do
  for graded in png tiff; do
    sed "\$a output: {graded: $graded}" fall.yaml >$graded.yaml
    for verb in "render --threads $threads" grade; do
      for count in $(seq 4 2 60); do
        rm -rf out/graded
        code=0
        # shellcheck disable=SC2086 # a verb and its options
        limited "$count" "$program" $verb $graded.yaml --frames 0-3 --out out 2>stderr || code=$?
        [ "$code" -ne 0 ] || break
        [ "$code" -eq 75 ] || fail "$verb, $graded, a limit of $count: $code: $(cat stderr)"
      done
      [ "$code" -eq 0 ] || fail "no limit was enough for $verb: $(cat stderr)"
    done
  done
done
# So do other verbs.
for verb in "check fall.yaml" "preview fall.yaml --size 16x16 --out out/still.png"; do
  for count in $(seq 1 14); do
    code=0
    # shellcheck disable=SC2086 # a verb and its options
    limited "$count" "$program" $verb >stdout 2>stderr || code=$?
    [ "$code" -eq 0 ] || [ "$code" -eq 75 ] || fail "$verb: exit code $code: $(cat stderr)"
  done
done
