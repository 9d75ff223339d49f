#!/usr/bin/env bash
# What `domefall farm submit` writes for other queue managers, given to programs that read it.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=farm_test.bash
source "$(dirname "${BASH_SOURCE[0]}")/farm_test.bash"
# shellcheck source-path=SCRIPTDIR source=farm_submit.bash
source "$(dirname "${BASH_SOURCE[0]}")/farm_submit.bash"
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
trap 'end_marked; rm -rf "$scratch"' EXIT
cd "$scratch"
write_show fall.yaml
"$DOMEFALL" render fall.yaml --out single --frames 0-11 --threads 1 2>single.log
# A show and a folder whose names a shell would take apart.
odd="it's \$HOME"
mkdir "$odd"
cp fall.yaml "$odd/fall.yaml"
submit=("$DOMEFALL" farm submit "$odd/fall.yaml" --frames 0-11 --chunk 5 --threads 1)

a_list_feeds_xargs_and_parallel() {
  expect 0 list "${submit[@]}" --engine list --out "$odd/x"
  [[ $(wc -l <list) == 3 ]] || fail "not 3 lines: $(cat list)"
  xargs -d '\n' -n 1 -P 2 sh -c <list 2>xargs.log || fail "$(cat xargs.log)"
  same_frames single "$odd/x" 12 || fail "the frames differ"
  expect 0 none "${submit[@]}" --engine list --out "$odd/x"
  [[ ! -s none ]] || fail "there is nothing to make: $(cat none)"
  expect 0 list "${submit[@]}" --engine list --out "$odd/p"
  if command -v parallel >/dev/null; then
    parallel -j 2 <list 2>parallel.log || fail "$(cat parallel.log)"
    same_frames single "$odd/p" 12 || fail "the frames differ"
  fi
}

an_openjd_template_keeps_to_its_schema_and_runs() {
  expect 0 job.json "${submit[@]}" --engine openjd --out "$odd/o" --movie review
  mkdir -p "$odd/o/graded"
  echo notes >"$odd/o/graded/notes.txt"
  python3 - job.json "$here/openjd_schema.json" <<'PY'
import json, subprocess, sys
job = json.load(open(sys.argv[1]))
try:
    import jsonschema
    jsonschema.validate(job, json.load(open(sys.argv[2])))
except ImportError:
    print("python3-jsonschema is not installed: the template is only run")
steps = {step["name"]: step for step in job["steps"]}
assert list(steps) == ["render", "verify", "movie"], list(steps)
assert steps["movie"]["dependencies"] == [{"dependsOn": "verify"}]
parameter, = steps["render"]["parameterSpace"]["taskParameterDefinitions"]
for value in parameter["range"]:
    run = steps["render"]["script"]["actions"]["onRun"]
    words = [w.replace("{{Task.Param.Frames}}", value) for w in [run["command"], *run["args"]]]
    out = subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True).stdout.splitlines()
    progress = [float(line.split()[1]) for line in out if line.startswith("openjd_progress: ")]
    assert progress == sorted(progress) and progress[-1] == 100, out
    assert any(line.startswith("openjd_status: frame ") for line in out), out
for name in ("verify", "movie"):
    run = steps[name]["script"]["actions"]["onRun"]
    subprocess.run([run["command"], *run["args"]], check=True, stdout=subprocess.DEVNULL)
PY
  rm "$odd/o/graded/notes.txt"
  same_frames single "$odd/o" 12 || fail "the frames differ"
  [[ -s $odd/o/fall_review.mp4 ]] || fail "no movie"
}

a_flamenco_job_compiles_to_tasks_that_run() {
  command -v node >/dev/null || { echo "node is not installed: not tried"; return; }
  expect 0 flamenco.json "${submit[@]}" --engine flamenco --out "$odd/f"
  node "$here/flamenco_stub.js" "$DOMEFALL_SOURCE/farm/flamenco/domefall.js" <flamenco.json >tasks.json
  python3 - tasks.json <<'PY'
import json, subprocess, sys
tasks = json.load(open(sys.argv[1]))
assert [t["name"] for t in tasks] == ["render-0-4", "render-5-9", "render-10-11", "verify"], tasks
assert tasks[-1]["after"] == [t["name"] for t in tasks[:-1]], tasks
for task in tasks:
    command, = task["commands"]
    words = [command["parameters"]["exe"], *command["parameters"]["args"]]
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
PY
  same_frames single "$odd/f" 12 || fail "the frames differ"
}

progress_is_told_in_the_form_of_each_manager() {
  local form
  for form in plain json afanasy; do
    "$DOMEFALL" render fall.yaml --out "$form.d" --frames 3-4 --threads 1 --progress "$form" \
      >"$form.out" 2>/dev/null
  done
  [[ $(cat plain.out) == $'frame 3: 1 of 2\nframe 4: 2 of 2' ]] || fail "$(cat plain.out)"
  [[ $(cat afanasy.out) == $'FRAME: 3\nPROGRESS: 100%\nFRAME: 4\nPROGRESS: 100%' ]] ||
    fail "$(cat afanasy.out)"
  python3 -c '
import json, sys
lines = [json.loads(line) for line in sys.stdin]
assert [(x["frame"], x["done"], x["total"], x["made"]) for x in lines] == [(3, 1, 2, True), (4, 2, 2, True)], lines
' <json.out
  expect 2 form.log "$DOMEFALL" render fall.yaml --out plain.d --progress loud
}

for claim in a_list_feeds_xargs_and_parallel an_openjd_template_keeps_to_its_schema_and_runs \
  a_flamenco_job_compiles_to_tasks_that_run progress_is_told_in_the_form_of_each_manager; do
  $claim
  pass "$claim"
done
