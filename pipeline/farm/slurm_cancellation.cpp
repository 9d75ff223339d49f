#include "pipeline/farm/slurm_cancellation.h"

#include <algorithm>
#include <sstream>

#include "pipeline/farm/worker_process.h"

namespace domefall {
namespace {

// Returns what follows a name in a line, up to the next space.
std::string value_behind(const std::string& line, const std::string& name) {
  const std::size_t at = line.find(name);
  if (at == std::string::npos) return {};
  const std::size_t begin = at + name.size();
  return line.substr(begin, line.find(' ', begin) - begin);
}

// Returns what a program prints, or nothing where it fails.
std::istringstream printed_by(const std::vector<std::string>& command) {
  std::string said;
  const WorkerEnd end = run_program(command, said, true);
  return std::istringstream(end.code == 0 && end.signal == 0 ? said : std::string());
}

}  // namespace

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
    if (const std::string state = value_behind(line, " JobState="); !state.empty())
      endings.push_back({state, value_behind(line, " EndTime=")});
  // The controller forgets a job some minutes after its end (MinJobAge).
  if (endings.empty()) {
    std::istringstream kept = printed_by({"sacct", "-n", "-P", "-X", "-j", job, "-o", "State,End"});
    for (std::string line; std::getline(kept, line);)
      if (const std::size_t bar = line.find('|'); bar != std::string::npos)
        endings.push_back({line.substr(0, bar), line.substr(bar + 1)});
  }
  return end_by_cancellation(endings);
}

}  // namespace domefall
