#include "pipeline/farm/slurm.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <sstream>

#include "pipeline/farm/shell_words.h"
#include "pipeline/farm/signal_inbox.h"
#include "pipeline/farm/worker_process.h"
#include "pipeline/image/errors.h"

namespace domefall {
namespace {

constexpr int kNoSuchProgram = 127;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

int number_or(const std::string& text, int otherwise) {
  const int number = std::atoi(text.c_str());  // NOLINT(cert-err34-c): 0 stands for no number
  return number > 0 ? number : otherwise;
}

std::string without_line_end(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

// Returns what follows `name=` in the output of scontrol, or an empty text if it is not there.
std::string field(const std::string& text, const std::string& name) {
  const std::size_t at = (" " + text).find(" " + name + "=");
  if (at == std::string::npos) return {};
  const std::size_t begin = at + name.size() + 1;
  return text.substr(begin, text.find_first_of(" \n", begin) - begin);
}

std::set<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::set<std::string> words;
  for (std::string word; stream >> word;) words.insert(word);
  return words;
}

// sbatch replaces %-patterns in the names of logs.
std::string log_pattern(const std::filesystem::path& path, const std::string& name) {
  std::string folder;
  for (const char c : path.string()) folder += c == '%' ? "%%" : std::string(1, c);
  return "--output=" + folder + "/" + name;
}

std::vector<std::string> with_engine_options(std::vector<std::string> command,
                                             const FarmPlan& plan) {
  command.insert(command.end(), plan.engine_options.begin(), plan.engine_options.end());
  return command;
}

// Keeps the next tries of a task off this node, where another one can take it.
void leave_out_this_node(const SlurmTask& task) {
  std::string job;
  run_program({"scontrol", "show", "job", "-o", task.id}, job, true);
  // Where the user asks for certain nodes, there may be no other.
  if (field(job, "ReqNodeList") != "(null)" || field(job, "Features") != "(null)") return;
  std::string excluded = field(job, "ExcNodeList");
  excluded = (excluded == "(null)" || excluded.empty() ? "" : excluded + ",") + task.node;
  std::string excluded_nodes, nodes;
  run_program({"scontrol", "show", "hostnames", excluded}, excluded_nodes, true);
  run_program({"sinfo", "-h", "-N", "-o", "%N", "-p", environment("SLURM_JOB_PARTITION"), "-t",
               "idle,alloc,mix,comp"},
              nodes, true);
  const std::set<std::string> left_out = words_of(excluded_nodes), there = words_of(nodes);
  if (std::includes(left_out.begin(), left_out.end(), there.begin(), there.end())) return;
  std::string said;
  run_program({"scontrol", "update", "JobId=" + task.id, "ExcNodeList=" + excluded}, said, true);
  if (!said.empty()) std::fputs(said.c_str(), stderr);
}

}  // namespace

int most_array_tasks(int patience_s) {
  std::string said;
  std::vector<std::string> command{"scontrol", "show", "config"};
  if (patience_s > 0) command.insert(command.begin(), {"timeout", fmt::to_string(patience_s)});
  const WorkerEnd end = run_program(command, said);
  if (end.code == kNoSuchProgram)
    throw InputError("scontrol: no such program; Slurm is not installed here");
  if (end.code != 0 || end.signal != 0) throw TemporaryError("scontrol: " + without_line_end(said));
  const std::size_t at = said.find("MaxArraySize");
  const std::size_t value = at == std::string::npos ? at : said.find('=', at);
  return value == std::string::npos ? kDefaultArrayTasks
                                    : number_or(said.substr(value + 1, 16), kDefaultArrayTasks);
}

std::vector<std::string> array_submission(const FarmPlan& plan, int round) {
  const std::size_t tasks = chunks_of_round(plan, round).size();
  const std::string throttle = plan.at_once > 0 ? fmt::format("%{}", plan.at_once) : "";
  std::vector<std::string> command = with_engine_options(
      {"sbatch", "--parsable", "--job-name=domefall-" + plan.show.stem().string(), "--nodes=1",
       "--ntasks=1", "--requeue",
       // By default the log of the first try is lost when a task is requeued.
       "--open-mode=append",
       // A minute before the time limit the task ends its frame and asks for more time.
       "--signal=B:USR1@60", fmt::format("--cpus-per-task={}", plan.threads),
       log_pattern(farm_log_folder(plan.out), "slurm_%A_%a.log")},
      plan);
  command.push_back(fmt::format("--array=0-{}{}", tasks - 1, throttle));
  command.push_back("--wrap=exec " +
                    shell_line({plan.program, "farm", "work", plan.out.string(), "--plan", plan.id,
                                "--round", fmt::to_string(round)}) +
                    " --task \"$SLURM_ARRAY_TASK_ID\"");
  return command;
}

std::vector<std::string> conclusion_submission(const FarmPlan& plan, int round,
                                               const std::string& after) {
  std::vector<std::string> command = with_engine_options(
      {"sbatch", "--parsable", "--job-name=domefall-verify-" + plan.show.stem().string(),
       "--nodes=1", "--ntasks=1", "--requeue", "--open-mode=append",
       fmt::format("--cpus-per-task={}", plan.threads),
       log_pattern(farm_folder(plan.out), "conclude_%j.log")},
      plan);
  if (!after.empty()) command.push_back("--dependency=afterany:" + after);
  command.push_back("--wrap=exec " +
                    shell_line({plan.program, "farm", "conclude", plan.out.string(), "--plan",
                                plan.id, "--round", fmt::to_string(round)}));
  return command;
}

std::string submit_to_slurm(const std::vector<std::string>& command) {
  std::string said;
  const WorkerEnd end = run_program(command, said);
  if (end.code == kNoSuchProgram)
    throw InputError("sbatch: no such program; Slurm is not installed here");
  if (end.code != 0 || end.signal != 0) {
    const bool away =
        said.find("contact") != std::string::npos || said.find("timed out") != std::string::npos;
    if (away) throw TemporaryError(without_line_end(said));
    throw InputError(without_line_end(said));
  }
  // A plugin may say something first.  The last line is that of --parsable, ID or ID;CLUSTER.
  const std::string text = without_line_end(said);
  const std::string line = text.substr(text.find_last_of('\n') + 1);
  return line.substr(0, line.find(';'));
}

void cancel_slurm_job(const std::string& job) {
  std::string said;
  run_program({"scancel", job}, said);
}

bool slurm_job_is_over(const std::string& job) {
  std::string said;
  const WorkerEnd end = run_program({"squeue", "-h", "-j", job, "-o", "%i"}, said);
  if (end.code == 0 && end.signal == 0) return without_line_end(said).empty();
  return said.find("Invalid job id") != std::string::npos;  // Slurm has forgotten it
}

bool is_in_slurm() { return !environment("SLURM_JOB_ID").empty(); }

SlurmTask this_slurm_task() {
  SlurmTask task;
  // The last task of an array has the array's id as its SLURM_JOB_ID, by which all tasks would be
  // requeued.
  const std::string array = environment("SLURM_ARRAY_JOB_ID");
  task.id = array.empty() ? environment("SLURM_JOB_ID")
                          : array + "_" + environment("SLURM_ARRAY_TASK_ID");
  task.node = environment("SLURMD_NODENAME");
  task.restarts = number_or(environment("SLURM_RESTART_COUNT"), 0);
  task.processors = number_or(environment("SLURM_CPUS_PER_TASK"),
                              number_or(environment("SLURM_CPUS_ON_NODE"), 1));
  return task;
}

bool requeue_slurm_task(const SlurmTask& task, bool elsewhere, SignalInbox& inbox) {
  // A job that exits with 75 and is requeued for that would cancel those that wait for the array
  // with afterok, even if the next try succeeds.  One that is requeued while it runs does not.
  // Slurm then ends it with TERM, but only a job that waits can be kept off a node.
  std::string said;
  const WorkerEnd end = run_program({"scontrol", "requeue", task.id}, said, true);
  if (end.code != 0 || end.signal != 0) {
    std::fputs(said.c_str(), stderr);
    return false;
  }
  if (elsewhere) leave_out_this_node(task);
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  while (std::chrono::steady_clock::now() < patience) {
    for (const int signal : inbox.take())
      if (signal == SIGTERM) return true;
    inbox.wait(1);
  }
  return true;
}

}  // namespace domefall
