#include "farm/slurm.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string_view>

#include "farm/commands.h"
#include "farm/signal_inbox.h"
#include "farm/worker_process.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/talk.h"

namespace domefall {
namespace {

constexpr int kNoSuchProgram = 127, kDefaultArrayTasks = 1001;

// Says whether Slurm's programs are to see a variable.
bool is_for_slurm(std::string_view name) {
  // These say which cluster is meant, and who asks.
  for (const std::string_view kept : {"SLURM_CONF", "SLURM_CLUSTERS", "SLURM_JWT"})
    if (name == kept) return true;
  // These are of the job in which this process runs, or choose what a program prints.
  for (const std::string_view begin :
       {"SLURM_", "SLURMD_", "SQUEUE_", "SCONTROL_", "SACCT_", "SINFO_", "SCANCEL_"})
    if (name.starts_with(begin)) return false;
  // These would make an array of the job that verifies, wait for it, lose what it says, or keep
  // DOMEFALL_ASSETS from it.
  for (const std::string_view changed :
       {"SBATCH_ARRAY_INX", "SBATCH_DEBUG", "SBATCH_ERROR", "SBATCH_EXPORT", "SBATCH_INPUT",
        "SBATCH_SIGNAL", "SBATCH_WAIT"})
    if (name == changed) return false;
  return true;
}

// Runs one of Slurm's programs, as run_program() does.  It does not see the variables of a job that
// this process may be in, nor those that would change what is submitted or printed, such as
// SBATCH_ARRAY_INX, SBATCH_WAIT or SQUEUE_STATES.  Those that say where and how much, such as
// SLURM_CONF and SBATCH_PARTITION, are the user's.
WorkerEnd run_slurm_program(const std::vector<std::string>& arguments, std::string& said,
                            bool ignores_term = false) {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable; ++variable) {
    const std::string_view text = *variable;
    if (is_for_slurm(text.substr(0, text.find('=')))) variables.emplace_back(text);
  }
  return run_program(arguments, said, ignores_term, std::move(variables));
}

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
  // A backslash turns the patterns off, and is left out itself.
  if (path.string().find('\\') != std::string::npos)
    throw InputError(path.string() +
                     ": Slurm cannot write logs where a path has a backslash; another --out is "
                     "needed");
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
  run_slurm_program({"scontrol", "show", "job", "-o", task.id}, job, true);
  // Where the user asks for certain nodes, there may be no other.
  if (field(job, "ReqNodeList") != "(null)" || field(job, "Features") != "(null)") return;
  std::string excluded = field(job, "ExcNodeList");
  excluded = (excluded == "(null)" || excluded.empty() ? "" : excluded + ",") + task.node;
  std::string excluded_nodes, nodes;
  run_slurm_program({"scontrol", "show", "hostnames", excluded}, excluded_nodes, true);
  run_slurm_program({"sinfo", "-h", "-N", "-o", "%N", "-p", environment("SLURM_JOB_PARTITION"),
                     "-t", "idle,alloc,mix,comp"},
                    nodes, true);
  const std::set<std::string> left_out = words_of(excluded_nodes), there = words_of(nodes);
  if (std::includes(left_out.begin(), left_out.end(), there.begin(), there.end())) return;
  std::string said;
  run_slurm_program({"scontrol", "update", "JobId=" + task.id, "ExcNodeList=" + excluded}, said,
                    true);
  if (!said.empty()) say(said);
}

// Returns what helps where Slurm refuses the processors of a task, or else nothing.
std::string processor_hint(const FarmPlan& plan, const std::string& said) {
  for (const std::string_view words :
       {"CPU count", "node configuration is not available", "More processors requested"})
    if (said.find(words) != std::string::npos)
      return fmt::format(
          "\na task asks for {} processor{} of a node; --threads asks for another number",
          plan.threads, plan.threads == 1 ? "" : "s");
  return {};
}

// Returns the id that sbatch prints for --parsable, ID or ID;CLUSTER, in its last line.  A plugin
// may say something before.
std::string job_id(const std::string& said) {
  const std::string text = without_line_end(said);
  const std::string line = text.substr(text.find_last_of('\n') + 1);
  std::string id = line.substr(0, line.find(';'));
  if (id.empty() || id.find_first_not_of("0123456789") != std::string::npos)
    throw InputError("sbatch names no job: " + text);
  return id;
}

// Asks for MaxArraySize, for so many seconds at most if these are not 0.
int told_array_tasks(int patience_s) {
  std::string said;
  std::vector<std::string> command{"scontrol", "show", "config"};
  if (patience_s > 0) command.insert(command.begin(), {"timeout", fmt::to_string(patience_s)});
  const WorkerEnd end = run_slurm_program(command, said);
  if (end.code == kNoSuchProgram)
    throw InputError("scontrol: no such program; Slurm is not installed here");
  if (end.code != 0 || end.signal != 0) throw TemporaryError("scontrol: " + without_line_end(said));
  const std::size_t at = said.find("MaxArraySize");
  const std::size_t value = at == std::string::npos ? at : said.find('=', at);
  return value == std::string::npos ? kDefaultArrayTasks
                                    : number_or(said.substr(value + 1, 16), kDefaultArrayTasks);
}

std::string submit_to_slurm(const FarmPlan& plan, const std::vector<std::string>& command) {
  std::string said;
  const WorkerEnd end = run_slurm_program(command, said);
  if (end.code == kNoSuchProgram)
    throw InputError("sbatch: no such program; Slurm is not installed here");
  if (end.code != 0 || end.signal != 0) {
    const bool away =
        said.find("contact") != std::string::npos || said.find("timed out") != std::string::npos;
    if (away) throw TemporaryError(without_line_end(said));
    throw InputError(without_line_end(said) + processor_hint(plan, said));
  }
  return job_id(said);
}

// Says whether none of a job's tasks waits or runs.  Returns false where the controller does not
// answer.
bool slurm_job_is_over(const std::string& job) {
  std::string said;
  const WorkerEnd end = run_slurm_program({"squeue", "-h", "-j", job, "-o", "%i"}, said);
  if (end.code == 0 && end.signal == 0) return without_line_end(said).empty();
  return said.find("Invalid job id") != std::string::npos;  // Slurm has forgotten it
}

// Returns what a program prints, or nothing where it fails.
std::istringstream printed_by(const std::vector<std::string>& command) {
  std::string said;
  const WorkerEnd end = run_slurm_program(command, said, true);
  return std::istringstream(end.code == 0 && end.signal == 0 ? said : std::string());
}

}  // namespace

int most_array_tasks(bool only_printed) {
  if (!only_printed) return told_array_tasks(0);
  constexpr int kPatienceS = 3;
  try {
    return told_array_tasks(kPatienceS);
  } catch (const InputError&) {
  } catch (const TemporaryError&) {
  }
  say(
      fmt::format("Slurm does not answer here; an array is taken to have {} tasks at most, which "
                  "is its default",
                  kDefaultArrayTasks));
  return kDefaultArrayTasks;
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
                                "--round", fmt::to_string(round), "--slurm"}) +
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
                                plan.id, "--round", fmt::to_string(round), "--slurm"}));
  return command;
}

std::string slurm_commands(const FarmPlan& plan) {
  const std::string array =
      plan.chunks.empty() ? std::string() : shell_line(array_submission(plan, 0)) + "\n";
  return array + shell_line(conclusion_submission(plan, 0, plan.chunks.empty() ? "" : "JOB")) +
         "\n";
}

std::string start_array(const FarmPlan& plan, int round) {
  return submit_to_slurm(plan, array_submission(plan, round));
}

std::string start_conclusion(const FarmPlan& plan, int round, const std::string& after) {
  return submit_to_slurm(plan, conclusion_submission(plan, round, after));
}

RoundOutcome wait_for_slurm(const FarmPlan&, int, const std::string& job, SignalInbox& inbox) {
  constexpr double kFirstPauseS = 0.5, kLongestPauseS = 10;
  for (double pause = kFirstPauseS;; pause = std::min(kLongestPauseS, 1.3 * pause)) {
    if (slurm_job_is_over(job)) return {};
    inbox.wait(pause);
    for (const int signal : inbox.take())
      if (signal != SIGUSR1) {
        say("job " + job + " goes on without this program; domefall farm status tells how far");
        return {.signal = signal};
      }
  }
}

void cancel_slurm_job(const std::string& job) {
  std::string said;
  run_slurm_program({"scancel", job}, said);
}

bool end_by_cancellation(const std::vector<SlurmEnding>& endings) {
  std::string cancelled, others;
  for (const SlurmEnding& ending : endings) {
    std::string& last = ending.state.starts_with("CANCELLED") ? cancelled : others;
    last = std::max(last, ending.time);
  }
  return !cancelled.empty() && cancelled >= others;
}

bool slurm_job_was_cancelled(const std::string& job) {
  std::vector<SlurmEnding> endings;
  std::istringstream known = printed_by({"scontrol", "show", "job", "-o", job});
  for (std::string line; std::getline(known, line);)
    if (const std::string state = field(line, "JobState"); !state.empty())
      endings.push_back({state, field(line, "EndTime")});
  // The controller forgets a job some minutes after its end (MinJobAge).
  if (endings.empty()) {
    std::istringstream kept = printed_by({"sacct", "-n", "-P", "-X", "-j", job, "-o", "State,End"});
    for (std::string line; std::getline(kept, line);)
      if (const std::size_t bar = line.find('|'); bar != std::string::npos)
        endings.push_back({line.substr(0, bar), line.substr(bar + 1)});
  }
  return end_by_cancellation(endings);
}

SlurmTask this_slurm_task(bool of_array) {
  if (environment("SLURM_JOB_ID").empty())
    throw InputError("--slurm: is for jobs that farm submit has made, and SLURM_JOB_ID names none");
  SlurmTask task;
  // The last task of an array has the array's id as its SLURM_JOB_ID, by which all tasks would be
  // requeued.
  task.id = of_array ? environment("SLURM_ARRAY_JOB_ID") + "_" + environment("SLURM_ARRAY_TASK_ID")
                     : environment("SLURM_JOB_ID");
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
  const WorkerEnd end = run_slurm_program({"scontrol", "requeue", task.id}, said, true);
  if (end.code != 0 || end.signal != 0) {
    say(said);
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
