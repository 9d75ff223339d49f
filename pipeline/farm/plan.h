// What a submission to a farm is to make, as DIR/farm/plan.json keeps it for the tasks, for those
// who verify the frames, and for the rounds that follow.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace domefall {

// What one task renders.
struct PlannedChunk {
  int round = 0, task = 0;
  std::string frames;      // as --frames takes them: 0-9,12
  double estimated_s = 0;  // by the clock, on a machine like the one that submits; 0: not estimated
};

// Chunks that were handed to an engine together.
struct FarmRound {
  int round = 0;
  std::string job;        // the engine's name for it; empty where the engine has none
  std::string submitted;  // UTC, 2026-01-01T00:00:00Z
};

struct FarmPlan {
  std::string version;  // what `domefall --version` says where the plan was made
  std::string program;  // the path of domefall on the nodes
  std::filesystem::path show, out;
  std::string frames;                       // all that are asked for, also those that are there
  std::vector<std::string> options;         // of domefall render
  std::string engine;                       // slurm, local, list, openjd or flamenco
  std::vector<std::string> engine_options;  // of sbatch
  int threads = 1;                          // of a task; of all workers together for local
  int at_once = 0;      // tasks that may run at the same time; 0: as many as the engine likes
  int retries = 3;      // how often a task is tried again
  int most_rounds = 2;  // how often what is missing or bad may be submitted again
  std::string movie;    // a preset, once all frames are good; empty: no movie
  std::string movie_file;
  std::string deliver;  // a folder for `domefall deliver`, likewise
  std::vector<PlannedChunk> chunks;
  std::vector<FarmRound> rounds;
};

// DIR/farm, DIR/farm/plan.json and DIR/farm/log.
std::filesystem::path farm_folder(const std::filesystem::path& out);
std::filesystem::path plan_file(const std::filesystem::path& out);
std::filesystem::path farm_log_folder(const std::filesystem::path& out);

// Throws TemporaryError where the file is not there or cannot be read, and InputError where it is
// no plan.
FarmPlan read_plan(const std::filesystem::path& out);

// Makes DIR/farm and DIR/farm/log and writes the plan at once.  Throws InputError where the path
// leads through a file, and else as throw_file_error().
void write_plan(const FarmPlan& plan);

// The chunks of a round.
std::vector<PlannedChunk> chunks_of_round(const FarmPlan& plan, int round);

// The time now as FarmRound::submitted.
std::string utc_now();

}  // namespace domefall
