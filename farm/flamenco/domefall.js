// The job type "domefall" of Flamenco 3, for its manager's folder `scripts`. The job itself comes
// from
//   domefall farm submit SHOW --engine flamenco --out DIR | curl -s --json @- MANAGER/api/v3/jobs
// with a task a chunk, and then one task after another that verifies the frames, repairs what is
// bad, and makes what else was asked for.

const JOB_TYPE = {
  label: "Domefall",
  description: "Render a black-hole show for planetariums",
  settings: [
    { key: "render_command", type: "string", required: true, visible: "web",
      description: "domefall render ... as a JSON list of words; the one after --frames is a chunk's" },
    { key: "chunks", type: "string", required: true, visible: "web",
      description: "frames of the tasks, as a JSON list of ranges such as 0-9,12" },
    { key: "later", type: "string", default: "[]", visible: "web",
      description: "what follows the frames, as a JSON list of objects with a name and a command" },
  ],
};

function taskOf(name, type, words) {
  const task = author.Task(name, type);
  task.addCommand(author.Command("exec", { exe: words[0], args: words.slice(1) }));
  return task;
}

function compileJob(job) {
  const settings = job.settings;
  const command = JSON.parse(settings.render_command);
  const place = command.indexOf("--frames") + 1;
  if (place === 0 || place === command.length) {
    throw new Error("render_command has no --frames with a value");
  }
  let before = [];
  for (const frames of JSON.parse(settings.chunks)) {
    const words = command.slice();
    words[place] = frames;
    const task = taskOf("render-" + frames, "misc", words);
    job.addTask(task);
    before.push(task);
  }
  for (const step of JSON.parse(settings.later || "[]")) {
    const task = taskOf(step.name, "misc", step.command);
    for (const needed of before) {
      task.addDependency(needed);
    }
    job.addTask(task);
    before = [task];
  }
}
