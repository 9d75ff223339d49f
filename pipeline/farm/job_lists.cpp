#include "pipeline/farm/job_lists.h"

#include <nlohmann/json.hpp>

#include "pipeline/farm/farm_task.h"
#include "pipeline/farm/finish.h"
#include "pipeline/farm/shell_words.h"
#include "pipeline/farm/utf8_json.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/utf8.h"

namespace domefall {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFramesOfTask = "{{Task.Param.Frames}}";

// A template's texts are format strings, which have no way to write {{ itself.
Json openjd_action(std::vector<std::string> command) {
  for (const std::string& word : command) {
    require_utf8(word);
    if (word != kFramesOfTask && word.find("{{") != std::string::npos)
      throw InputError(word + ": Open Job Description takes {{ for the beginning of a variable; " +
                       "a path without it will do");
  }
  const std::string program = command.front();
  command.erase(command.begin());
  return {{"actions", {{"onRun", {{"command", program}, {"args", command}}}}}};
}

std::string name_of_job(const FarmPlan& plan) { return "domefall " + plan.show.stem().string(); }

std::vector<std::string> repair_command(const FarmPlan& plan) {
  return {plan.program, "farm", "verify", plan.out.string(), "--plan", plan.id, "--repair"};
}

// Returns what comes after the frames, in which each step waits for the one before.
std::vector<std::pair<std::string, std::vector<std::string>>> later_steps(const FarmPlan& plan) {
  std::vector<std::pair<std::string, std::vector<std::string>>> steps{
      {"verify", repair_command(plan)}};
  if (!plan.movie.empty()) steps.emplace_back("movie", movie_command(plan));
  if (!plan.deliver.empty()) steps.emplace_back("deliver", deliver_command(plan));
  return steps;
}

}  // namespace

std::string list_of_commands(const FarmPlan& plan) {
  std::string text;
  for (const PlannedChunk& chunk : plan.chunks)
    text += shell_line(render_command(plan, chunk.frames, plan.threads)) + "\n";
  return text;
}

std::string openjd_template(const FarmPlan& plan) {
  Json steps = Json::array();
  std::string before;
  if (!plan.chunks.empty()) {
    Json ranges = Json::array();
    for (const PlannedChunk& chunk : plan.chunks) ranges.push_back(chunk.frames);
    std::vector<std::string> command = render_command(plan, kFramesOfTask, plan.threads);
    command.insert(command.end(), {"--progress", "openjd"});
    Json parameters = Json::array({{{"name", "Frames"}, {"type", "STRING"}, {"range", ranges}}});
    before = "render";
    steps.push_back({{"name", before},
                     {"parameterSpace", {{"taskParameterDefinitions", parameters}}},
                     {"script", openjd_action(command)}});
  }
  for (const auto& [name, command] : later_steps(plan)) {
    Json step{{"name", name}};
    if (!before.empty()) step["dependencies"] = Json::array({{{"dependsOn", before}}});
    step["script"] = openjd_action(command);
    steps.push_back(step);
    before = name;
  }
  constexpr std::size_t kLongestName = 128;
  const Json json{{"specificationVersion", "jobtemplate-2023-09"},
                  {"name", first_characters(name_of_job(plan), kLongestName)},
                  {"steps", steps}};
  return utf8_json(json, 2) + "\n";
}

std::string flamenco_job(const FarmPlan& plan) {
  Json chunks = Json::array();
  for (const PlannedChunk& chunk : plan.chunks) chunks.push_back(chunk.frames);
  std::vector<std::string> command = render_command(plan, "", plan.threads);
  // Settings are texts and numbers, so that lists go as JSON in a text.
  Json later = Json::array();
  for (const auto& [name, words] : later_steps(plan))
    later.push_back({{"name", name}, {"command", words}});
  const Json json{{"name", name_of_job(plan)},
                  {"type", "domefall"},
                  {"priority", 50},
                  {"submitter_platform", "linux"},
                  {"settings",
                   {{"render_command", utf8_json(command)},
                    {"chunks", utf8_json(chunks)},
                    {"later", utf8_json(later)}}},
                  {"metadata", {{"show", plan.show.string()}, {"out", plan.out.string()}}}};
  return utf8_json(json, 2) + "\n";
}

}  // namespace domefall
