// What may be drawn over frames for review and for teaching, never unless it is asked for.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace domefall {

// In the order in which they are drawn.
enum class OverlayKind {
  kGrid,
  kRim,
  kSafeArea,
  kSweetSpot,
  kSilhouette,
  kEinsteinRing,
  kStarNames,
  kBurnIn,
};

inline constexpr std::array<std::pair<OverlayKind, std::string_view>, 8> kOverlays{
    {{OverlayKind::kGrid, "grid"},
     {OverlayKind::kRim, "rim"},
     {OverlayKind::kSafeArea, "safe_area"},
     {OverlayKind::kSweetSpot, "sweet_spot"},
     {OverlayKind::kSilhouette, "silhouette"},
     {OverlayKind::kEinsteinRing, "einstein_ring"},
     {OverlayKind::kStarNames, "star_names"},
     {OverlayKind::kBurnIn, "burn_in"}}};

// The overlays of a list "rim,grid", each once, in the order of drawing.
// Throws InputError naming the word that is none of them, with the nearest one.
std::vector<OverlayKind> parse_overlays(std::string_view list);

// The list of their names.
std::string overlay_names(const std::vector<OverlayKind>& overlays);

}  // namespace domefall
