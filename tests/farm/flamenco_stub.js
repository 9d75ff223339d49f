// Runs a Flamenco job type over a job on standard input, as its manager does, and prints the tasks:
//   node flamenco_stub.js JOB_TYPE.js <job.json
"use strict";
const fs = require("fs");
const vm = require("vm");

const tasks = [];
const author = {
  Command: (name, parameters) => ({ name, parameters }),
  Task: (name, type) => ({
    name, type, commands: [], after: [],
    addCommand(command) { this.commands.push(command); },
    addDependency(task) {
      if (!tasks.includes(task)) throw new Error("a dependency that the job does not have");
      this.after.push(task.name);
    },
  }),
};
const request = JSON.parse(fs.readFileSync(0, "utf8"));
const context = vm.createContext({ author });
vm.runInContext(fs.readFileSync(process.argv[2], "utf8"), context);
const type = vm.runInContext("JOB_TYPE", context);
const known = type.settings.map((setting) => setting.key);
for (const key of Object.keys(request.settings)) {
  if (!known.includes(key)) throw new Error("the job type has no setting " + key);
  if (typeof request.settings[key] !== "string") throw new Error(key + " is not text");
}
for (const setting of type.settings) {
  if (setting.required && !(setting.key in request.settings)) {
    throw new Error("the setting " + setting.key + " is missing");
  }
}
const job = { settings: request.settings, addTask: (task) => tasks.push(task) };
vm.runInContext("compileJob", context)(job);
console.log(JSON.stringify(tasks.map(({ name, type, commands, after }) =>
  ({ name, type, commands, after }))));
