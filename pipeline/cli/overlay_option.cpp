#include "pipeline/cli/overlay_option.h"

#include "pipeline/image/errors.h"

namespace domefall {

void add_overlay_option(CLI::App& verb, std::string& names) {
  std::string known;
  for (const auto& [kind, name] : kOverlays) known.append(known.empty() ? "" : ", ").append(name);
  verb.add_option(
      "--overlay", names,
      "draw over the frames, for review and teaching: any of " + known + ", joined by commas");
}

void overlay(Show& show, const std::string& names) {
  try {
    show.overlays = parse_overlays(names);
  } catch (const InputError& error) {
    throw InputError("--overlay " + names + ": " + error.what());
  }
  if (!show.overlays.empty()) show.title += " (overlay " + overlay_names(show.overlays) + ")";
}

}  // namespace domefall
