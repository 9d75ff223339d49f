#include "pipeline/cli/overlay_option.h"

#include "pipeline/image/errors.h"

namespace domefall {

void add_overlay_option(CLI::App& verb, std::string& names) {
  std::string known;
  for (const auto& [kind, name] : kOverlays) known.append(known.empty() ? "" : ", ").append(name);
  verb.add_option(
          "--overlay", names,
          "draw over the frames, for review and teaching: any of " + known + ", joined by commas")
      ->check([](const std::string& list) {
        return list.empty() ? std::string("got no name") : std::string();
      });
}

void overlay(Show& show, const std::string& names) {
  if (names.empty()) return;
  try {
    show.overlays = parse_overlays(names);
  } catch (const InputError& error) {
    throw InputError("--overlay " + names + ": " + error.what());
  }
  show.title += " (overlay " + overlay_names(show.overlays) + ")";
}

}  // namespace domefall
