#!/usr/bin/env bash
# What `domefall farm submit` writes for other queue managers, given to programs that read it.
source "$(dirname "$0")/farm_test.bash"
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

# Frames that follow one another by a step, or by no rule, as in a show of 20 minutes.
the_frames_of_an_openjd_task_have_few_characters() {
  local frames options
  cp fall.yaml long.yaml
  sed -i 's/duration_s: 2, /duration_s: 1200, /' long.yaml
  frames=$(python3 -c 'print(",".join(str(k * k) for k in range(100)) + "," + ",".join(str(9900 + 3 * k + k % 2) for k in range(700)))')
  for options in "--frames 0-11999x10 --chunk 400" "--frames $frames --chunk 800" "--frames $frames"; do
    # shellcheck disable=SC2086 # several words
    expect 0 long.json "$DOMEFALL" farm submit long.yaml --engine openjd --out l --dry-run $options
    python3 - long.json "$here/openjd_schema.json" "$options" <<'PY'
import json, sys
text = open(sys.argv[1]).read()
job = json.loads(text[text.index("{"):])
try:
    import jsonschema
    jsonschema.validate(job, json.load(open(sys.argv[2])))
except ImportError:
    pass
values = job["steps"][0]["parameterSpace"]["taskParameterDefinitions"][0]["range"]
assert max(map(len, values)) <= 1024 and len(values) <= 1024, [len(v) for v in values]
def numbers(text):
    for part in text.split(","):
        part, _, step = part.partition("x")
        first, _, last = part.partition("-")
        yield from range(int(first), int(last or first) + 1, int(step or 1))
asked = sorted(set(numbers(sys.argv[3].split()[1])))
assert sorted(n for v in values for n in numbers(v)) == asked, "other frames"
PY
  done
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

try_all_claims
