#include "pipeline/show/show.h"

#include <algorithm>
#include <cmath>

#include "pipeline/sources/stars/solar_system.h"

namespace domefall {

StarCatalogue read_star_field(const StarField& field, double max_magnitude, double epoch,
                              std::size_t whole) {
  StarCatalogue stars = read_star_catalogue(field.catalogue, max_magnitude, epoch, whole);
  if (!field.planets_year) return stars;
  const StarCatalogue planets = planets_as_stars(*field.planets_year);
  for (const Star& planet : planets.stars)
    if (planet.v_magnitude <= max_magnitude) stars.stars.push_back(planet);
  sort_by_magnitude(stars.stars);
  stars.names.insert(stars.names.end(), planets.names.begin(), planets.names.end());
  return stars;
}

double value_at(const Segment& segment, Channel channel, double t, double constant) {
  const std::optional<Curve>& curve = segment.curves[channel];
  return curve ? value_at(*curve, t) : constant;
}

std::vector<std::pair<std::string, const Curve*>> curves_of(const Show& show,
                                                            const Segment& segment) {
  std::vector<std::pair<std::string, const Curve*>> curves;
  for (const Channel channel : kEveryChannel)
    if (segment.curves[channel]) curves.emplace_back(key_of(channel), &*segment.curves[channel]);
  for (std::size_t k = 0; k < segment.magnitudes.size(); ++k)
    if (segment.magnitudes[k])
      curves.emplace_back("bodies." + show.bodies[k].name + ".magnitude", &*segment.magnitudes[k]);
  return curves;
}

const SkyBackground& background_of(const Show& show, int segment, SkyRegion region) {
  const auto k = static_cast<std::size_t>(segment);
  const bool own = k < show.timeline.size() && show.timeline[k].backgrounds[region];
  return own ? *show.timeline[k].backgrounds[region] : show.sky[region].background;
}

std::vector<double> segment_times(const Show& show) {
  std::vector<double> times;
  times.reserve(show.timeline.size() + 1);
  double end = 0;
  for (const Segment& segment : show.timeline) {
    times.push_back(end - segment.dissolve_s);
    end = times.back() + segment.duration_s;
  }
  times.push_back(end);
  return times;
}

double end_of(const Show& show) {
  // The joints hold the running sum of the durations, which is not formed again for each call.
  return show.joints.empty() ? segment_times(show).back()
                             : show.joints.back().begin_s + show.timeline.back().duration_s;
}

int frame_count(const Show& show) {
  return std::max(1, static_cast<int>(std::lround(end_of(show) * show.frames_per_second)));
}

int nearest_frame(const Show& show, double time_s) {
  return std::clamp(static_cast<int>(std::lround(time_s * show.frames_per_second)), 0,
                    frame_count(show) - 1);
}

}  // namespace domefall
