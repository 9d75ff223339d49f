#include "pipeline/cli/overlay_option.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "pipeline/cli/option_types.h"
#include "pipeline/image/errors.h"

namespace domefall {

void add_overlay_option(CLI::App& verb, std::string& names) {
  std::vector<std::string_view> known;
  known.reserve(std::size(kOverlays));
  for (const auto& [kind, name] : kOverlays) known.push_back(name);
  verb.add_option("--overlay", names,
                  "draw over the frames, for review and teaching: any of these, joined by commas")
      ->type_name(one_of(known).append(kListMark))
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
  const bool flat = std::ranges::all_of(
      show.overlays, [](OverlayKind kind) { return kind == OverlayKind::kBurnIn; });
  if (std::holds_alternative<Cubemap>(show.projection) && !flat)
    throw InputError("--overlay " + names +
                     ": only burn-in can be drawn on a cubemap, whose faces would cut the others; "
                     "look at them in another projection");
  show.title += " (overlay " + overlay_names(show.overlays) + ")";
}

}  // namespace domefall
