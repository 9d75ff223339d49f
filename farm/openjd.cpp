#include <nlohmann/json.hpp>

#include "farm/commands.h"
#include "farm/engine.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/utf8.h"

namespace domefall {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFramesOfTask = "{{Task.Param.Frames}}";

// A template's texts are format strings, which have no way to write {{ itself.
Json openjd_action(Words command) {
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

}  // namespace

std::string openjd_template(const FarmPlan& plan) {
  Json steps = Json::array();
  std::string before;
  if (!plan.chunks.empty()) {
    Json ranges = Json::array();
    for (const PlannedChunk& chunk : plan.chunks) ranges.push_back(chunk.frames);
    Words command = render_command(plan, kFramesOfTask, plan.threads);
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
                  {"name", first_characters("domefall " + plan.show.stem().string(), kLongestName)},
                  {"steps", steps}};
  return utf8_json(json, 2) + "\n";
}

}  // namespace domefall
