#include "farm/engine.h"

#include <algorithm>
#include <array>

#include "farm/slurm.h"
#include "pipeline/base/errors.h"

namespace domefall {
namespace {

int ten_thousand_tasks(bool) { return 10'000; }
// A step of Open Job Description has so many tasks, whose values are so long.
int openjd_tasks(bool) { return 1024; }
constexpr std::size_t kLongestOpenJdValue = 1024;

std::string no_job(const FarmPlan&, int) { return {}; }

constexpr std::array kEngines{
    Engine{.name = "slurm",
           .about = "a job array, verified and completed",
           .takes_options = true,
           .most_tasks = most_array_tasks,
           .limit = "Slurm allows (MaxArraySize)",
           .text = slurm_commands,
           .start = start_array,
           .wait = wait_for_slurm,
           .conclude = start_conclusion,
           .cancel = cancel_slurm_job,
           .was_cancelled = slurm_job_was_cancelled,
           .cancel_command = "scancel"},
    Engine{.name = "local",
           .about = "processes on this machine",
           .is_local = true,
           .most_tasks = ten_thousand_tasks,
           .text = list_of_commands,
           .start = no_job,
           .wait = run_locally},
    Engine{.name = "list",
           .about = "a command line a task",
           .makes_products = false,
           .most_tasks = ten_thousand_tasks,
           .text = list_of_commands},
    Engine{.name = "openjd",
           .about = "an Open Job Description template",
           .most_tasks = openjd_tasks,
           .longest_frames = kLongestOpenJdValue,
           .text = openjd_template},
    Engine{.name = "flamenco",
           .about = "a job of farm/flamenco/domefall.js",
           .most_tasks = ten_thousand_tasks,
           .text = flamenco_job},
};

}  // namespace

std::span<const Engine> engines() { return kEngines; }

const Engine& engine_named(std::string_view name) {
  const auto found = std::ranges::find(kEngines, name, &Engine::name);
  if (found == kEngines.end())
    throw InputError("engine " + std::string(name) + ": there is no such engine");
  return *found;
}

}  // namespace domefall
