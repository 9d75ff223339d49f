#include "pipeline/sky/catalogue/amend/hipparcos_repair.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace domefall {
namespace {

using StarIndices = std::vector<std::uint32_t>;

class Repair {
 public:
  // Finds the stars of each Hipparcos number, which components of one star share.
  Repair(RawCatalogue& catalogue, HipparcosRepair& done) : stars_(catalogue.stars), done_(done) {
    for (std::uint32_t i = 0; i < stars_.size(); ++i)
      if (stars_[i].hip != 0) with_number_[stars_[i].hip].push_back(i);
  }

  // Lays one star of Hipparcos over those that bear its number, or adds it.
  void lay_over(const CatalogueStar& hipparcos) {
    const auto found = with_number_.find(hipparcos.hip);
    if (found == with_number_.end()) {
      stars_.push_back(hipparcos);
      ++done_.added;
    } else {
      take_colour(found->second, hipparcos.colour);
      take_magnitude(found->second, hipparcos.v);
    }
  }

 private:
  // The colour of Hipparcos replaces that of a single star.  It says little about one star of
  // several, so there it only fills a gap.
  void take_colour(const StarIndices& places, float colour) {
    if (colour == kNoColour) return;
    for (const std::uint32_t i : places) {
      const bool had_none = stars_[i].colour == kNoColour;
      if (!had_none && places.size() > 1) continue;
      stars_[i].colour = colour;
      if (had_none) ++done_.colours;
    }
  }

  // Magnitudes do not add, but fluxes do: the sum of the stars has V = -2.5 log10(sum of 10^(-0.4
  // V)).
  void take_magnitude(const StarIndices& places, float v) {
    double flux = 0;
    for (const std::uint32_t i : places) {
      if (places.size() > 1 && !stars_[i].v_is_rough) return;
      flux += std::pow(10, -0.4 * stars_[i].v);
    }
    const double sum = -2.5 * std::log10(flux);
    for (const std::uint32_t i : places) {
      // A shift that is the same for all multiplies all fluxes by one factor, so that their ratios
      // stay.
      stars_[i].v = places.size() == 1 ? v : static_cast<float>(stars_[i].v + (v - sum));
      stars_[i].v_is_rough = false;
      ++done_.stars;
    }
  }

  std::vector<CatalogueStar>& stars_;
  HipparcosRepair& done_;
  std::unordered_map<std::uint32_t, StarIndices> with_number_;
};

}  // namespace

HipparcosRepair repair_by_hipparcos(RawCatalogue& catalogue, const RawCatalogue& hipparcos) {
  HipparcosRepair done;
  Repair repair(catalogue, done);
  for (const CatalogueStar& star : hipparcos.stars)
    if (star.hip != 0) repair.lay_over(star);
  return done;
}

}  // namespace domefall
