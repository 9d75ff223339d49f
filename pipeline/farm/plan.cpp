#include "pipeline/farm/plan.h"

#include <ctime>
#include <nlohmann/json.hpp>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/regular_file.h"

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

Json plan_json(const FarmPlan& plan) {
  Json json{{"domefall", plan.version},   {"program", plan.program},
            {"show", plan.show.string()}, {"out", plan.out.string()},
            {"frames", plan.frames},      {"options", plan.options},
            {"engine", plan.engine},      {"engine_options", plan.engine_options},
            {"threads", plan.threads},    {"at_once", plan.at_once},
            {"retries", plan.retries},    {"most_rounds", plan.most_rounds},
            {"movie", plan.movie},        {"movie_file", plan.movie_file},
            {"deliver", plan.deliver},    {"chunks", Json::array()},
            {"rounds", Json::array()}};
  for (const PlannedChunk& chunk : plan.chunks) json["chunks"].push_back(chunk_json(chunk));
  for (const FarmRound& round : plan.rounds) json["rounds"].push_back(round_json(round));
  return json;
}

FarmPlan plan_of(const Json& json) {
  FarmPlan plan;
  json.at("domefall").get_to(plan.version);
  json.at("program").get_to(plan.program);
  plan.show = json.at("show").get<std::string>();
  plan.out = json.at("out").get<std::string>();
  json.at("frames").get_to(plan.frames);
  json.at("options").get_to(plan.options);
  json.at("engine").get_to(plan.engine);
  json.at("engine_options").get_to(plan.engine_options);
  json.at("threads").get_to(plan.threads);
  json.at("at_once").get_to(plan.at_once);
  json.at("retries").get_to(plan.retries);
  json.at("most_rounds").get_to(plan.most_rounds);
  json.at("movie").get_to(plan.movie);
  json.at("movie_file").get_to(plan.movie_file);
  json.at("deliver").get_to(plan.deliver);
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

}  // namespace

fs::path farm_folder(const fs::path& out) { return out / "farm"; }
fs::path plan_file(const fs::path& out) { return farm_folder(out) / "plan.json"; }
fs::path farm_log_folder(const fs::path& out) { return farm_folder(out) / "log"; }

FarmPlan read_plan(const fs::path& out) {
  const fs::path file = plan_file(out);
  constexpr std::uint64_t kMostBytes = 1 << 28;
  const std::string text = read_file(file, kMostBytes);
  try {
    return plan_of(Json::parse(text));
  } catch (const Json::exception& error) {
    throw InputError(file.string() +
                     ": not a plan that domefall farm submit has written: " + error.what());
  }
}

void write_plan(const FarmPlan& plan) {
  make_farm_folder(farm_log_folder(plan.out));
  std::string text;
  try {
    text = plan_json(plan).dump(1) + "\n";
  } catch (const Json::type_error&) {
    throw InputError(plan_file(plan.out).string() +
                     ": the paths of the show and its frames must be UTF-8");
  }
  write_atomically(plan_file(plan.out), text);
}

std::vector<PlannedChunk> chunks_of_round(const FarmPlan& plan, int round) {
  std::vector<PlannedChunk> chunks;
  for (const PlannedChunk& chunk : plan.chunks)
    if (chunk.round == round) chunks.push_back(chunk);
  return chunks;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::string text(32, '\0');
  text.resize(std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts));
  return text;
}

}  // namespace domefall
