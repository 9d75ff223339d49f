#include "farm/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "pipeline/base/errors.h"
#include "pipeline/base/utf8.h"

namespace domefall {
namespace {

void add_option(std::vector<std::string>& command, const std::string& name,
                const std::string& value) {
  if (!value.empty()) command.insert(command.end(), {name, value});
}

void add_option_of_frames(std::vector<std::string>& command, const FarmPlan& plan,
                          const std::string& name) {
  const auto at = std::ranges::find(plan.options, name);
  if (at != plan.options.end()) add_option(command, name, *(at + 1));
}

void require_utf8_within(const nlohmann::ordered_json& json) {
  if (json.is_string()) require_utf8(json.get_ref<const std::string&>());
  if (!json.is_structured()) return;
  for (const nlohmann::ordered_json& value : json) require_utf8_within(value);
}

Words movie_command(const FarmPlan& plan) {
  Words command{plan.program, "movie",  plan.show.string(), "--preset",
                plan.movie,   "--from", plan.out.string()};
  add_option(command, "--out", plan.movie_file);
  add_option(command, "--frames", plan.frames);
  add_option_of_frames(command, plan, "--size");
  add_option_of_frames(command, plan, "--overlay");
  command.insert(command.end(), plan.movie_options.begin(), plan.movie_options.end());
  return command;
}

Words deliver_command(const FarmPlan& plan) {
  Words command{plan.program,      "deliver", plan.show.string(), "--from",
                plan.out.string(), "--out",   plan.deliver};
  add_option_of_frames(command, plan, "--size");
  add_option_of_frames(command, plan, "--overlay");
  command.insert(command.end(), plan.deliver_options.begin(), plan.deliver_options.end());
  return command;
}

}  // namespace

Words render_command(const FarmPlan& plan, const std::string& frames, int threads) {
  Words command{plan.program,      "render",    plan.show.string(),     "--frames", frames, "--out",
                plan.out.string(), "--threads", fmt::to_string(threads)};
  command.insert(command.end(), plan.options.begin(), plan.options.end());
  return command;
}

std::vector<std::pair<std::string, Words>> product_commands(const FarmPlan& plan) {
  std::vector<std::pair<std::string, Words>> commands;
  if (!plan.movie.empty()) commands.emplace_back("movie", movie_command(plan));
  if (!plan.deliver.empty()) commands.emplace_back("deliver", deliver_command(plan));
  return commands;
}

std::vector<std::pair<std::string, Words>> later_steps(const FarmPlan& plan) {
  auto steps = product_commands(plan);
  steps.insert(steps.begin(), {"verify",
                               {plan.program, "farm", "verify", plan.out.string(), "--plan",
                                plan.id, "--repair"}});
  return steps;
}

std::string shell_word(std::string_view word) {
  refuse_control_characters(word);
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789%+,-./:=@_";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string_view::npos)
    return std::string(word);
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shell_line(const Words& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

void require_utf8(std::string_view text) {
  const std::string spelt = spell_bad_bytes(text);
  if (spelt != text)
    throw InputError(spelt + ": is not UTF-8, which the plans and jobs of a farm are written in");
  refuse_control_characters(text);
}

std::string utf8_json(const nlohmann::ordered_json& json, int indent) {
  require_utf8_within(json);
  return json.dump(indent);
}

}  // namespace domefall
