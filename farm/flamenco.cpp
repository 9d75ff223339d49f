#include <nlohmann/json.hpp>

#include "farm/commands.h"
#include "farm/engine.h"

namespace domefall {

std::string flamenco_job(const FarmPlan& plan) {
  using Json = nlohmann::ordered_json;
  Json chunks = Json::array();
  for (const PlannedChunk& chunk : plan.chunks) chunks.push_back(chunk.frames);
  // Settings are texts and numbers, so that lists go as JSON in a text.
  Json later = Json::array();
  for (const auto& [name, words] : later_steps(plan))
    later.push_back({{"name", name}, {"command", words}});
  const Json json{{"name", "domefall " + plan.show.stem().string()},
                  {"type", "domefall"},
                  {"priority", 50},
                  {"submitter_platform", "linux"},
                  {"settings",
                   {{"render_command", utf8_json(render_command(plan, "", plan.threads))},
                    {"chunks", utf8_json(chunks)},
                    {"later", utf8_json(later)}}},
                  {"metadata", {{"show", plan.show.string()}, {"out", plan.out.string()}}}};
  return utf8_json(json, 2) + "\n";
}

}  // namespace domefall
