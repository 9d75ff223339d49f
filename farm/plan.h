// A FarmPlan is what a submission to a farm is to make.  DIR/farm/plan_ID.json keeps it for its
// tasks, for those who verify its frames, and for the rounds that follow.  Each submission has a
// plan of its own.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace domefall {

// A PlannedChunk is what one task renders.
struct PlannedChunk {
  int round = 0, task = 0;
  std::string frames;      // as --frames takes them: 0-9,12
  double estimated_s = 0;  // on a machine like the one that submits, when idle; 0: not estimated
};

// A FarmRound has chunks that were handed to an engine together.
struct FarmRound {
  int round = 0;
  std::string job;        // the engine's name for it; empty where the engine has none
  std::string submitted;  // UTC, 2026-01-01T00:00:00Z
};

struct FarmPlan {
  std::string id;       // of new_plan_id(); its jobs and processes name it
  std::string version;  // what `domefall --version` says where the plan was made
  std::string program;  // the path of domefall on the nodes
  std::filesystem::path show, out;
  std::string frames;  // that are asked for, also those that are there; empty: all of the show
  std::vector<std::string> options;         // of domefall render
  std::string engine;                       // by its name (engine.h)
  std::vector<std::string> engine_options;  // after --
  int threads = 1;                          // of a task; of all workers together for local
  int at_once = 0;      // tasks that may run at the same time; 0: as many as the engine likes
  int retries = 3;      // how often a task is tried again
  int most_rounds = 2;  // how often what is missing or bad may be submitted again
  std::string movie{};  // a preset, once all frames are good; empty: no movie
  std::string movie_file{};
  std::string deliver{};  // a folder for `domefall deliver`, likewise
  std::vector<std::string> movie_options{}, deliver_options{};  // of these two
  std::vector<PlannedChunk> chunks;
  std::vector<FarmRound> rounds{};  // empty until the engine has accepted the first one
};

// Returns an id that no other submission has.  It is the time in UTC to the microsecond, so that a
// later one sorts behind, and four random digits.
std::string new_plan_id();

// These return DIR/farm, DIR/farm/plan_ID.json and DIR/farm/log.
std::filesystem::path farm_folder(const std::filesystem::path& out);
std::filesystem::path plan_file(const std::filesystem::path& out, const std::string& id);
std::filesystem::path farm_log_folder(const std::filesystem::path& out);

// Reads a plan.  Throws TemporaryError where the file is not there or cannot be read, and
// InputError where it is no plan or the id is none.
FarmPlan read_plan(const std::filesystem::path& out, const std::string& id);

// Returns the latest plan of a folder that an engine has accepted, or nothing if there is none.
// One of a part of the show that found nothing to do is passed over where there is an earlier one.
// Throws as read_plan().
std::optional<FarmPlan> newest_plan(const std::filesystem::path& out);

// Throws InputError for a path or an option that a plan cannot hold, because it is not UTF-8.
void check_plan_text(const FarmPlan& plan);

// Makes DIR/farm and DIR/farm/log and writes the plan whole or not at all.  Throws as
// check_plan_text() before anything is made, InputError where the path leads through a file, and
// else as throw_file_error().
void write_plan(const FarmPlan& plan);

// Removes the file of a plan that no engine has accepted, and leaves any other alone.
void drop_unaccepted_plan(const FarmPlan& plan);

std::vector<PlannedChunk> chunks_of_round(const FarmPlan& plan, int round);

// Returns the show or the folder of the frames, where it cannot be used at the moment, and
// otherwise an empty text.
std::string missing_path(const FarmPlan& plan);

// Returns the time now as FarmRound::submitted.
std::string utc_now();

}  // namespace domefall
