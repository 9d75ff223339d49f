#include "pipeline/cli/sky_check_page.h"

#include <algorithm>
#include <cstdio>

#include "trajectories/equatorial.h"

namespace domefall {
namespace {

constexpr std::size_t kOthersShown = 4;

void print_fit(const char* what, const OrientationFit& fit) {
  std::printf("%-7s %5.0f %%  %5.0f %%  %6.3f   %s\n", what, 100 * fit.stars, 100 * fit.clouds,
              fit.band, orientation_phrase(fit.orientation).c_str());
}

}  // namespace

std::string verdict_sentence(const SkyCheck& check) {
  const std::string by = check.by_stars ? "by its stars" : "by its Milky Way";
  if (check.verdict == SkyVerdict::kAgrees)
    return "it lies on the sky as stated, " + by + ": " +
           orientation_phrase(check.stated.orientation);
  if (check.verdict == SkyVerdict::kOther)
    return "stated as " + orientation_phrase(check.stated.orientation) + ", but, " + by +
           ", it fits better as " + orientation_phrase(check.others[0].orientation);
  return "neither its stars nor its Milky Way are clear enough to tell its orientation by";
}

void print_check(const SkyCheck& check, const std::vector<KnownPlace>& places) {
  std::puts("place                      RA deg  Dec deg  light over its surroundings");
  for (const KnownPlace& p : places) {
    const Equatorial at = equatorial(p.direction);
    std::printf("%-25s %7.2f  %7.2f  %.3g\n", p.name.c_str(), at.ra_deg, at.dec_deg, p.contrast);
  }
  std::puts("\n         stars   clouds  band     orientation");
  print_fit("stated", check.stated);
  for (std::size_t k = 0; k < std::min(kOthersShown, check.others.size()); ++k)
    print_fit("other", check.others[k]);
}

}  // namespace domefall
