// Overlays are drawn over frames for review and for teaching, never unless they are asked for.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace domefall {

// The kinds stand in the order in which they are drawn.  The last one draws nothing and leaves out the
// show's titles.
enum class OverlayKind {
  kGrid,
  kRim,
  kSafeArea,
  kSweetSpot,
  kSilhouette,
  kEinsteinRing,
  kErgosphere,
  kStarNames,
  kBurnIn,
  kNoTitles,
};

inline constexpr std::array<std::pair<OverlayKind, std::string_view>, 10> kOverlays{
    {{OverlayKind::kGrid, "grid"},
     {OverlayKind::kRim, "rim"},
     {OverlayKind::kSafeArea, "safe_area"},
     {OverlayKind::kSweetSpot, "sweet_spot"},
     {OverlayKind::kSilhouette, "silhouette"},
     {OverlayKind::kEinsteinRing, "einstein_ring"},
     {OverlayKind::kErgosphere, "ergosphere"},
     {OverlayKind::kStarNames, "star_names"},
     {OverlayKind::kBurnIn, "burn_in"},
     {OverlayKind::kNoTitles, "no_titles"}}};

// Returns the overlays of a list "rim,grid", each once, in the order of drawing.  Throws InputError
// for a word that names none of them, with the nearest word that does.
std::vector<OverlayKind> parse_overlays(std::string_view list);

// Returns the list of their names.
std::string overlay_names(const std::vector<OverlayKind>& overlays);

}  // namespace domefall
