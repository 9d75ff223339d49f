#include "pipeline/show/overlay_kind.h"

#include <algorithm>

#include "pipeline/base/errors.h"
#include "pipeline/show/nearest_word.h"

namespace domefall {
namespace {

OverlayKind overlay_named(std::string_view word) {
  std::vector<std::string_view> known;
  for (const auto& [kind, name] : kOverlays) {
    if (name == word) return kind;
    known.push_back(name);
  }
  throw InputError("overlays are " + listed(known) + ", got '" + shown(word) + "'" +
                   did_you_mean(word, known));
}

}  // namespace

std::vector<OverlayKind> parse_overlays(std::string_view list) {
  std::vector<OverlayKind> overlays;
  for (std::size_t comma = 0; comma != std::string_view::npos;) {
    comma = list.find(',');
    overlays.push_back(overlay_named(list.substr(0, comma)));
    if (comma != std::string_view::npos) list.remove_prefix(comma + 1);
  }
  std::ranges::sort(overlays);
  overlays.erase(std::unique(overlays.begin(), overlays.end()), overlays.end());
  return overlays;
}

std::string overlay_names(const std::vector<OverlayKind>& overlays) {
  std::string names;
  // The names come in the order of drawing, whatever the order of the list is, so that equal lists
  // have equal names.
  for (const auto& [kind, name] : kOverlays)
    if (std::ranges::find(overlays, kind) != overlays.end())
      names.append(names.empty() ? "" : ",").append(name);
  return names;
}

}  // namespace domefall
