#include "farm/plan.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "farm/commands.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/new_file.h"
#include "pipeline/base/regular_file.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json chunk_json(const PlannedChunk& chunk) {
  Json json{{"round", chunk.round}, {"task", chunk.task}, {"frames", chunk.frames}};
  if (chunk.estimated_s > 0) json["estimated_s"] = chunk.estimated_s;
  return json;
}

Json round_json(const FarmRound& round) {
  return {{"round", round.round}, {"job", round.job}, {"submitted", round.submitted}};
}

// Visits what a plan's file has by its name, but for chunks and rounds.
template <class Plan, class Visit>
void each_field(Plan& plan, const Visit& visit) {
  visit("id", plan.id);
  visit("domefall", plan.version);
  visit("program", plan.program);
  visit("show", plan.show);
  visit("out", plan.out);
  visit("frames", plan.frames);
  visit("options", plan.options);
  visit("engine", plan.engine);
  visit("engine_options", plan.engine_options);
  visit("threads", plan.threads);
  visit("at_once", plan.at_once);
  visit("retries", plan.retries);
  visit("most_rounds", plan.most_rounds);
  visit("movie", plan.movie);
  visit("movie_file", plan.movie_file);
  visit("deliver", plan.deliver);
  visit("movie_options", plan.movie_options);
  visit("deliver_options", plan.deliver_options);
}

Json plan_json(const FarmPlan& plan) {
  Json json;
  each_field(plan, [&](const char* name, const auto& value) { json[name] = value; });
  json["chunks"] = Json::array();
  json["rounds"] = Json::array();
  for (const PlannedChunk& chunk : plan.chunks) json["chunks"].push_back(chunk_json(chunk));
  for (const FarmRound& round : plan.rounds) json["rounds"].push_back(round_json(round));
  return json;
}

std::string plan_text(const FarmPlan& plan) { return utf8_json(plan_json(plan), 1) + "\n"; }

FarmPlan plan_of(const Json& json) {
  FarmPlan plan;
  each_field(plan, [&](const char* name, auto& value) { json.at(name).get_to(value); });
  for (const Json& chunk : json.at("chunks"))
    plan.chunks.push_back(
        {chunk.at("round"), chunk.at("task"), chunk.at("frames"), chunk.value("estimated_s", 0.0)});
  for (const Json& round : json.at("rounds"))
    plan.rounds.push_back({round.at("round"), round.at("job"), round.at("submitted")});
  return plan;
}

void make_farm_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error == std::errc::not_a_directory || error == std::errc::file_exists)
    throw InputError(folder.string() + ": the folder cannot be made: " + error.message());
  if (error) throw_file_error(folder, error.value());
}

bool had_nothing_to_do(const FarmPlan& plan) {
  return plan.chunks.empty() && !plan.frames.empty() && plan.movie.empty() && plan.deliver.empty();
}

std::string utc_text(const char* form, std::time_t time) {
  std::tm parts{};
  gmtime_r(&time, &parts);
  std::string text(32, '\0');
  text.resize(std::strftime(text.data(), text.size(), form, &parts));
  return text;
}

}  // namespace

fs::path farm_folder(const fs::path& out) { return out / "farm"; }
fs::path plan_file(const fs::path& out, const std::string& id) {
  return farm_folder(out) / ("plan_" + id + ".json");
}
fs::path farm_log_folder(const fs::path& out) { return farm_folder(out) / "log"; }

std::string new_plan_id() {
  constexpr unsigned kFourDigits = 0xFFFF;
  const auto now = std::chrono::duration_cast<std::chrono::microseconds>(
                       std::chrono::system_clock::now().time_since_epoch())
                       .count();
  constexpr long kSecond = 1'000'000;
  return utc_text("%Y%m%dT%H%M%S", now / kSecond) +
         fmt::format("_{:06}_{:04x}", now % kSecond, std::random_device()() & kFourDigits);
}

FarmPlan read_plan(const fs::path& out, const std::string& id) {
  if (id.find('/') != std::string::npos)
    throw InputError("--plan " + id + ": expected the ID of a file farm/plan_ID.json");
  const fs::path file = plan_file(out, id);
  constexpr std::uint64_t kMostBytes = 1 << 28;
  const std::string text = read_file(file, kMostBytes);
  try {
    FarmPlan plan = plan_of(Json::parse(text));
    // A job's id becomes an argument of Slurm's programs.
    for (const FarmRound& round : plan.rounds)
      if (round.job.find_first_not_of("0123456789") != std::string::npos)
        throw InputError(file.string() + ": the job of a round must be a number, got '" +
                         round.job + "'");
    return plan;
  } catch (const Json::exception& error) {
    throw InputError(file.string() +
                     ": not a plan that domefall farm submit has written: " + error.what());
  }
}

std::optional<FarmPlan> newest_plan(const fs::path& out) {
  const std::string prefix = "plan_", suffix = ".json";
  std::vector<std::string> ids;
  std::error_code error;  // a folder that is not there has no plans
  for (fs::directory_iterator entry(farm_folder(out), error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename();
    if (name.starts_with(prefix) && name.ends_with(suffix))
      ids.push_back(name.substr(prefix.size(), name.size() - prefix.size() - suffix.size()));
  }
  std::ranges::sort(ids, std::greater());
  std::optional<FarmPlan> idle;
  for (const std::string& id : ids) {
    try {
      FarmPlan plan = read_plan(out, id);
      if (plan.rounds.empty()) continue;
      if (!had_nothing_to_do(plan)) return plan;
      if (!idle) idle = std::move(plan);
    } catch (const TemporaryError&) {
      // A submission that was refused has removed it meanwhile.
      if (fs::exists(plan_file(out, id), error)) throw;
    }
  }
  return idle;
}

void drop_unaccepted_plan(const FarmPlan& plan) {
  std::error_code error;
  if (read_plan(plan.out, plan.id).rounds.empty()) fs::remove(plan_file(plan.out, plan.id), error);
}

void check_plan_text(const FarmPlan& plan) { (void)plan_text(plan); }

void write_plan(const FarmPlan& plan) {
  const std::string text = plan_text(plan);
  make_farm_folder(farm_log_folder(plan.out));
  write_atomically(plan_file(plan.out, plan.id), text);
}

std::vector<PlannedChunk> chunks_of_round(const FarmPlan& plan, int round) {
  std::vector<PlannedChunk> chunks;
  for (const PlannedChunk& chunk : plan.chunks)
    if (chunk.round == round) chunks.push_back(chunk);
  return chunks;
}

std::string missing_path(const FarmPlan& plan) {
  if (access(plan.show.c_str(), R_OK) != 0) return plan.show.string();
  std::error_code error;
  if (!fs::is_directory(plan.out, error)) return plan.out.string();
  return {};
}

std::string utc_now() { return utc_text("%Y-%m-%dT%H:%M:%SZ", std::time(nullptr)); }

}  // namespace domefall
