#include "pipeline/cli/sky_check_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "trajectories/equatorial.h"

namespace domefall {
namespace {

constexpr std::size_t kOthersShown = 4;

void print_fit(const char* what, const OrientationFit& fit) {
  fmt::print("{:7} {:5.0f} %  {:5.0f} %  {:6.3f}   {}\n", what, 100 * fit.stars, 100 * fit.clouds,
             fit.band, orientation_phrase(fit.orientation));
}

}  // namespace

std::string verdict_sentence(const SkyCheck& check) {
  const std::string_view by = check.by_stars ? "by its stars" : "by its Milky Way";
  const std::string stated = orientation_phrase(check.stated.orientation);
  if (check.verdict == SkyVerdict::kAgrees)
    return fmt::format("it lies on the sky as stated, {}: {}", by, stated);
  if (check.verdict == SkyVerdict::kOther)
    return fmt::format("stated as {}, but, {}, it fits better as {}", stated, by,
                       orientation_phrase(check.others[0].orientation));
  return "neither its stars nor its Milky Way are clear enough to tell its orientation by";
}

void print_check(const SkyCheck& check, const std::vector<KnownPlace>& places) {
  fmt::print("place                      RA deg  Dec deg  light over its surroundings\n");
  for (const KnownPlace& p : places) {
    const Equatorial at = equatorial(p.direction);
    fmt::print("{:25} {:7.2f}  {:7.2f}  {:.3g}\n", p.name, at.ra_deg, at.dec_deg, p.contrast);
  }
  fmt::print("\n         stars   clouds  band     orientation\n");
  print_fit("stated", check.stated);
  for (std::size_t k = 0; k < std::min(kOthersShown, check.others.size()); ++k)
    print_fit("other", check.others[k]);
}

}  // namespace domefall
