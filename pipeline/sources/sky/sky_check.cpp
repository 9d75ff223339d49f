#include "pipeline/sources/sky/sky_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "pipeline/sources/sky/cube_face.h"
#include "trajectories/degree.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

// check_orientation() in the header says what these numbers decide.
constexpr std::size_t kBrightest = 150, kDensest = 40'000;
// A point stands out of its surroundings from the first contrast on, a cloud from the second.
constexpr double kStandsOut = 1.3;
constexpr double kCloudStandsOut = 1.15;
constexpr double kStarsEnough = 0.5, kStarsMargin = 0.15, kBandEnough = 0.3, kBandMargin = 0.1;
// These are 1536 places all over the sky, about 5.6 degrees apart, which is near the blur.
constexpr int kBandFace = 16;
constexpr double kBandBlur = 5 * kDegree;
constexpr double kKernelEnd = 8;  // the Gaussian is cut at exp(-8)
constexpr int kNamedStars = 10;

double light(const SkyMap& map, const V3d& direction, double footprint) {
  return luminance(map.sample(direction, footprint));
}

V3d beside(const V3d& d, double angle, double turn) {
  // Within 26 degrees of the z axis the x axis stands in for it, so that the product never gets
  // short.
  const V3d aside = d.cross(std::abs(d.z) < 0.9 ? V3d(0, 0, 1) : V3d(1, 0, 0)).normalized();
  const V3d across = d.cross(aside);
  return std::cos(angle) * d + std::sin(angle) * (std::cos(turn) * aside + std::sin(turn) * across);
}

std::vector<double> ring(const SkyMap& map, const V3d& d, double angle, double footprint) {
  constexpr int kPlaces = 12;
  std::vector<double> around;
  around.reserve(kPlaces);
  for (int k = 0; k < kPlaces; ++k)
    around.push_back(light(map, beside(d, angle, 2 * std::numbers::pi * k / kPlaces), footprint));
  std::sort(around.begin(), around.end());
  return around;
}

// Returns inside/around.  It is 1 where both are dark, and infinite where only the surroundings
// are.
double ratio(double inside, double around) {
  if (!(inside > 0)) return around > 0 ? 0 : 1;
  return around > 0 ? inside / around : HUGE_VAL;
}

// A place that is dark must be darker than its surroundings by the factor by which a cloud must be
// brighter.
struct NamedPlace {
  const char* name;
  double ra_deg, dec_deg, radius_deg;
  bool dark = false;

  SkyDirection direction() const { return sky_direction(ra_deg, dec_deg); }
  double radius() const { return radius_deg * kDegree; }
  bool stands_out(double contrast) const {
    return dark ? contrast < 1 / kCloudStandsOut : contrast > kCloudStandsOut;
  }
};

// The places are those of NED and SIMBAD, J2000.  The radius is that of the part that stands out of
// the surroundings.
constexpr std::array<NamedPlace, 8> kClouds{{{"Large Magellanic Cloud", 80.9, -69.8, 2.5},
                                             {"Small Magellanic Cloud", 13.2, -72.8, 1.2},
                                             {"M 31", 10.68, 41.27, 0.5},
                                             {"Carina Nebula", 161.3, -59.7, 0.8},
                                             {"Large Sagittarius Cloud", 271, -28.5, 2},
                                             {"Small Sagittarius Cloud", 274.2, -18.5, 0.8},
                                             {"Scutum Cloud", 281.3, -6.5, 1.5},
                                             {"Coalsack (dark)", 192.5, -62.9, 1.5, true}}};

double contrast(const SkyMap& map, const V3d& d, double radius) {
  const std::vector<double> around = ring(map, d, 2.5 * radius, radius);
  return ratio(light(map, d, radius), around[around.size() / 2]);
}

// Says whether there is a point of light near a place, within a texel or a tenth of a degree,
// whichever is larger.
bool stands_out(const SkyMap& map, const V3d& d) {
  const double texel = std::numbers::pi / 2 / map.levels()[0].size;
  const double near = std::max(texel, 0.1 * kDegree);
  const double peak = std::max(light(map, d, texel), ring(map, d, near, texel).back());
  const std::vector<double> around = ring(map, d, 4 * near, texel);
  return ratio(peak, around[around.size() / 2]) > kStandsOut;
}

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&values](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> rank(values.size());
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    for (std::size_t k = first; k < end; ++k)
      rank[order[k]] = static_cast<double>(first + end - 1) / 2;
  }
  return rank;
}

// Returns Pearson's correlation, or 0 if one of the two is constant.
double correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const auto mean = [](const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  };
  const double x0 = mean(x), y0 = mean(y);
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - x0) * (x[k] - x0);
    yy += (y[k] - y0) * (y[k] - y0);
    xy += (x[k] - x0) * (y[k] - y0);
  }
  return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0;
}

// A band holds places all over the sky and the ranks of the density of stars at them.
struct Band {
  std::vector<V3d> places;
  std::vector<double> density;
};

// Returns the stars about d, weighted by a Gaussian: 1 - cos(angle) is half of the square of a
// small angle.
double density_at(const V3d& d, const StarCatalogue& catalogue) {
  const std::size_t count = std::min(catalogue.stars.size(), kDensest);
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    // The exponent is angle^2/(2 kBandBlur^2).
    const double x = (1 - d.dot(catalogue.stars[k].direction.v)) / (kBandBlur * kBandBlur);
    // Beyond the cut a star counts less than 3.4e-4 of what it counts at its place.
    if (x < kKernelEnd) sum += std::exp(-x);
  }
  return sum;
}

Band band_of(const StarCatalogue& catalogue) {
  Band band;
  for (int face = 0; face < 6; ++face)
    for (int j = 0; j < kBandFace; ++j)
      for (int i = 0; i < kBandFace; ++i) {
        const V3d d = direction_of(texel_centre(face, i, j, kBandFace)).normalized();
        band.places.push_back(d);
        band.density.push_back(density_at(d, catalogue));
      }
  band.density = ranks(band.density);
  return band;
}

// A Judge compares one map with the catalogue under any number of orientations.
class Judge {
 public:
  Judge(const SkyMap& map, const Orientation& stated, const StarCatalogue& catalogue)
      : map_(map),
        catalogue_(catalogue),
        band_(band_of(catalogue)),
        panorama_from_map_(panorama_from_equatorial(stated)) {}

  OrientationFit fit(const Orientation& orientation) const {
    // The map was made with the stated orientation, so a direction goes into the panorama by the
    // assumed orientation and back out of it by the stated one.
    const M33d assumed = panorama_from_equatorial(orientation);
    const auto in_map = [&](const V3d& d) {
      return apply_transposed(panorama_from_map_, apply(assumed, d));
    };
    const std::size_t count = std::min(catalogue_.stars.size(), kBrightest);
    int found = 0;
    for (std::size_t k = 0; k < count; ++k)
      found += stands_out(map_, in_map(catalogue_.stars[k].direction.v));
    std::vector<double> seen;
    seen.reserve(band_.places.size());
    for (const V3d& d : band_.places) seen.push_back(light(map_, in_map(d), 2 * kBandBlur));
    int clouds = 0;
    for (const NamedPlace& cloud : kClouds)
      clouds += cloud.stands_out(contrast(map_, in_map(cloud.direction().v), cloud.radius()));
    // The correlation of the ranks is Spearman's.
    return {orientation, count ? found / static_cast<double>(count) : 0,
            correlation(ranks(seen), band_.density), clouds / static_cast<double>(kClouds.size())};
  }

 private:
  const SkyMap& map_;
  const StarCatalogue& catalogue_;
  Band band_;
  M33d panorama_from_map_;
};

// Returns all orientations but the stated one, with the middle turned by quarters: 2 x 2 x 2 x 4 -
// 1 = 31.
std::vector<Orientation> alternatives(const Orientation& stated) {
  std::vector<Orientation> all;
  for (const SkyFrame frame : {SkyFrame::kEquatorial, SkyFrame::kGalactic})
    for (const bool right : {false, true})
      for (const bool south : {false, true})
        for (const double turn : {0.0, 90.0, 180.0, 270.0}) {
          const Orientation o{frame, right, south, std::fmod(stated.centre_deg + turn, 360)};
          if (turn != 0 || frame != stated.frame || right != stated.longitude_right ||
              south != stated.south_up)
            all.push_back(o);
        }
  return all;
}

KnownPlace place_at(const SkyMap& map, const std::string& name, const SkyDirection& at,
                    double radius) {
  return {name, at, radius, contrast(map, at.v, radius)};
}

}  // namespace

SkyCheck check_orientation(const SkyMap& map, const Orientation& stated,
                           const StarCatalogue& catalogue) {
  const Judge judge(map, stated, catalogue);
  SkyCheck check{SkyVerdict::kUnclear, false, judge.fit(stated), {}};
  for (const Orientation& o : alternatives(stated)) check.others.push_back(judge.fit(o));
  // If the map shows stars, one orientation finds most of the bright ones and another does not.
  double most = check.stated.stars, least = most;
  for (const OrientationFit& f : check.others) {
    most = std::max(most, f.stars);
    least = std::min(least, f.stars);
  }
  check.by_stars = most >= kStarsEnough && most - least >= 2 * kStarsMargin;
  const auto score = [&check](const OrientationFit& f) {
    return check.by_stars ? f.stars : (f.band + f.clouds) / 2;
  };
  std::stable_sort(check.others.begin(), check.others.end(),
                   [&](const auto& a, const auto& b) { return score(a) > score(b); });
  const double own = score(check.stated), best = score(check.others[0]);
  const double enough = check.by_stars ? kStarsEnough : kBandEnough;
  const double margin = check.by_stars ? kStarsMargin : kBandMargin;
  // The verdict is unclear if no orientation fits well, or if another fits a little better.
  if (best >= enough && best - own >= margin)
    check.verdict = SkyVerdict::kOther;
  else if (own >= enough && own >= best)
    check.verdict = SkyVerdict::kAgrees;
  return check;
}

std::vector<KnownPlace> known_places(const SkyMap& map, const StarCatalogue& catalogue) {
  std::vector<KnownPlace> places;
  const double texel = std::numbers::pi / 2 / map.levels()[0].size;
  // A name has exactly the direction of its star in the catalogue.
  for (const Star& star : catalogue.stars) {
    if (places.size() == kNamedStars) break;
    const auto name = std::find_if(
        catalogue.names.begin(), catalogue.names.end(),
        [&star](const NamedStar& n) { return (n.direction.v - star.direction.v).length() < 1e-6; });
    if (name != catalogue.names.end())
      places.push_back(
          place_at(map, name->name, star.direction, std::max(1.5 * texel, 0.1 * kDegree)));
  }
  for (const NamedPlace& p : kClouds)
    places.push_back(place_at(map, p.name, p.direction(), p.radius()));
  return places;
}

}  // namespace domefall
