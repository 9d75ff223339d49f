#include "pipeline/show/timeline_section.h"

#include <cmath>

namespace domefall {
namespace {

// Whether the observer rests in the static frame, to rounding.
bool is_at_rest(const Trajectory& trajectory) {
  if (std::holds_alternative<StaticObserver>(trajectory)) return true;
  const auto* given = std::get_if<GivenVelocity>(&trajectory);
  if (!given || given->r <= kStaticInnermost) return false;
  const V3d rest =
      given->r == kFlatSpace ? V3d(0, 0, 0) : resting_celerity(given->r, given->tetrad);
  return (given->celerity - rest).length() <= 1e-12 * (1 + rest.length());
}

double swept_azimuth(const Segment& s) {
  return point_at(s.trajectory, s.tau_end).azimuth - point_at(s.trajectory, s.tau_begin).azimuth;
}

void check_target(const Item& segment, const Segment& read) {
  const bool sees_no_sky = point_at(read.trajectory, read.tau_begin).region == Region::kIV;
  if (sees_no_sky && std::holds_alternative<LookAtSky>(read.camera.attitude))
    segment.fail(
        "has a camera that looks at a place on the sky, but from region IV no sky is seen; give "
        "the segment another camera.look_at");
}

void check_motion(const Item& segment, const Segment& read) {
  if (!std::holds_alternative<LookAlongMotion>(read.camera.attitude)) return;
  if (!is_at_rest(read.trajectory)) return;
  segment.fail(
      "has a camera that looks along the motion, but its observer does not move; give "
      "the segment another camera.look_at");
}

std::optional<TimedTrajectory> read_motion(const Section& section, const Stage& stage,
                                           Lookup& lookup) {
  const Item* trajectory = section.find("trajectory");
  if (!trajectory && !stage.mass_solar)
    return TimedTrajectory{StaticObserver{}, 0, stage.duration_s};
  section.require("trajectory", ", e.g. {type: infall, from_r: 30}");
  return trajectory ? read_trajectory(*trajectory, stage, lookup) : std::nullopt;
}

// `azimuth` has been swept before.
Segment read_segment(const Item& item, const Show& show, double azimuth, const ShowCamera& camera,
                     Lookup& lookup) {
  const Section section(item, {"duration_s", "trajectory", "camera"});
  const auto duration = section.required_number("duration_s", Range{"seconds"}.above(0));
  Segment segment;
  segment.duration_s = duration.value_or(1);
  const CameraKeys keys = read_segment_camera(section.find("camera"), camera, lookup);
  segment.camera = camera_from(keys, show.projection);
  const Stage stage{show.mass_solar, show.hole_at, show.heading, azimuth, segment.duration_s};
  if (const auto motion = read_motion(section, stage, lookup)) {
    segment.trajectory = motion->trajectory;
    segment.tau_begin = motion->tau_begin;
    segment.tau_end = motion->tau_end;
    segment.pace = motion->pace;
    check_target(item, segment);
    check_motion(item, segment);
  }
  return segment;
}

}  // namespace

std::vector<Segment> read_timeline(const Section& section, const Show& show,
                                   const ShowCamera& camera, Lookup& lookup) {
  std::vector<Segment> timeline;
  const Item* list = section.require("timeline", ": a list of segments");
  const auto items = list ? read_list(*list) : std::nullopt;
  if (!items) return timeline;
  double frames = 0, azimuth = 0;
  for (const Item& item : *items) {
    timeline.push_back(read_segment(item, show, azimuth, camera, lookup));
    azimuth += swept_azimuth(timeline.back());
    const bool fitted = frames <= kMostFrames;
    frames += timeline.back().duration_s * show.frames_per_second;
    if (fitted && frames > kMostFrames)
      item.fail("brings the show to " + short_number(frames) + " frames; at most " +
                std::to_string(kMostFrames) + " are possible");
  }
  if (frames < 0.5)
    list->fail("ends after " + short_number(frames / show.frames_per_second) +
               " s, before half a frame is over; at " + short_number(show.frames_per_second) +
               " frames per second a frame lasts " + short_number(1 / show.frames_per_second) +
               " s");
  return timeline;
}

}  // namespace domefall
