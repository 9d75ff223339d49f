#include "pipeline/report/made_up_stars.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace domefall {
namespace {

// A StarCount is the number of stars as bright as a magnitude or brighter.
struct StarCount {
  double magnitude, stars;
};
constexpr std::array<StarCount, 8> kCounts{{{-1.5, 1},
                                            {6.5, 8805},
                                            {8, 45630},
                                            {9, 130720},
                                            {10, 357145},
                                            {11, 945959},
                                            {12, 2083385},
                                            {13, kMostMadeUpStars}}};

}  // namespace

// The counts are ascending, so the first one that reaches the rank ends its interval.  There ln
// rank is linear in V, as the counts of stars nearly are.
double magnitude_of_rank(double rank) {
  std::size_t k = 1;
  while (k + 1 < kCounts.size() && kCounts[k].stars < rank) ++k;
  const StarCount &a = kCounts[k - 1], &b = kCounts[k];
  return a.magnitude +
         (b.magnitude - a.magnitude) * std::log(rank / a.stars) / std::log(b.stars / a.stars);
}

RawCatalogue made_up_stars(std::size_t count) {
  constexpr double kBluestMade = -0.2, kReddestMade = 1.8, kTwoPi = 2 * std::numbers::pi;
  std::mt19937 random(1);
  // The distributions of the standard library differ from library to library, so none is used.
  const auto from = [&random](double least, double most) {
    // The generator gives integers below 2^32.  A number lies in the middle of its step, so it is
    // never `least` or `most` itself, and no star stands at a pole.
    constexpr double kRange = 4294967296.0;
    return least + (most - least) * (static_cast<double>(random()) + 0.5) / kRange;
  };
  RawCatalogue catalogue;
  catalogue.text = {"made up, as many by magnitude as Tycho-2 has", "none", "domefall report"};
  catalogue.stars.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    // By Archimedes, equal steps of z cut the sphere into zones of equal area.
    const double z = from(-1, 1), phi = from(0, kTwoPi), rho = std::sqrt(1 - z * z);
    CatalogueStar& star = catalogue.stars[k];
    star.direction = {V3d(rho * std::cos(phi), rho * std::sin(phi), z)};
    star.v = static_cast<float>(magnitude_of_rank(static_cast<double>(k) + 1));
    star.colour = static_cast<float>(from(kBluestMade, kReddestMade));
  }
  return catalogue;
}

}  // namespace domefall
