#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "pipeline/show/carried_camera.h"
#include "pipeline/show/file/marked_events.h"
#include "pipeline/show/file/sections.h"
#include "pipeline/show/file/show_time.h"
#include "pipeline/show/file/trajectory_section.h"
#include "pipeline/show/observer_track.h"

namespace domefall {
namespace {

constexpr double kTimeRounding = 1e-9;    // of sums of seconds
constexpr double kLongest = kMostFrames;  // seconds, at one frame a second

// Says whether the camera of a segment, which lasts from `begin` to `end`, ever has an attitude of
// this kind.
template <class Kind>
bool ever_has(const Segment& s, double begin, double end) {
  if (s.attitudes.empty()) return std::holds_alternative<Kind>(s.camera.attitude);
  for (std::size_t k = 0; k < s.attitudes.size(); ++k) {
    const bool last = k + 1 == s.attitudes.size();
    // An attitude matters from the keyframe before it to the one after it.
    const bool gone = !last && s.attitudes[k + 1].at_s <= begin;
    const bool still_to_come = k > 0 && s.attitudes[k - 1].at_s >= end;
    if (!gone && !still_to_come && std::holds_alternative<Kind>(s.attitudes[k].attitude))
      return true;
  }
  return false;
}

// A TimelineReader first reads the ways of all segments, since each begins where the one before
// ends, and then what is seen on them.
class TimelineReader {
 public:
  TimelineReader(Show& show, Lookup& lookup)
      : show_(show), events_(show.markers, show.frames_per_second), lookup_(lookup) {}

  void read_way(const Item& item) {
    Course course{item, Section(item, {"timeline"})};
    const Section& section = course.section;
    Segment segment;
    // The dissolve comes first, since a duration that is a marker counts from where the segment
    // begins.
    const double dissolve = read_dissolve(section);
    const Item* duration = section.require("duration_s", " (seconds)");
    Marker* const event = duration ? events_.coming(*duration) : nullptr;
    std::optional<double> seconds;
    if (event)
      seconds = read_seconds_until(*event, course, *duration);
    else if (duration)
      seconds = read_time(*duration, section.range("duration_s"), show_.markers, end_ - dissolve);
    segment.duration_s = seconds.value_or(1);
    if (fits_dissolve(section, dissolve, segment)) segment.dissolve_s = dissolve;
    segment.fades = read_fades(section);
    check_fades(section, segment.fades, segment.duration_s, "the segment");
    course.begin_s = end_ - segment.dissolve_s;
    if (seconds || !event) course.moves = read_motion(course, segment);
    end_ = course.begin_s + segment.duration_s;
    if (event && seconds) event->at_s = end_;
    if (course.moves && !show_.spacetime.is_flat()) events_.follow(segment, course.begin_s);
    joint_ = joint_after(
        segments_.empty() ? first_joint(show_, segment) : joint_into(joint_, segment), segment);
    segments_.push_back(std::move(segment));
    courses_.push_back(std::move(course));
  }

  void read_views(const ShowCamera& camera, const std::vector<Keyframe>& keyframes) {
    camera_ = camera, keyframes_ = keyframes;
    for (std::size_t k = 0; k < segments_.size(); ++k) {
      const auto& [item, section, begin, moves] = courses_[k];
      Segment& segment = segments_[k];
      read_view(section, begin, segment);
      if (moves) check_targets(item, segment, begin);
      segment.titles = read_titles(section, {begin, begin + segment.duration_s}, show_, lookup_);
    }
  }

  double end() const { return end_; }
  std::vector<Segment> take() { return std::move(segments_); }

 private:
  // A Course is a segment of the file whose way has been read.
  struct Course {
    Item item;
    Section section;
    double begin_s = 0;
    bool moves = false;  // without a mistake
  };

  double read_dissolve(const Section& section) const {
    const Item* item = section.find("dissolve_s");
    if (!item) return 0;
    if (!segments_.empty()) return read_time(*item, section.range("dissolve_s")).value_or(0);
    item->fail("needs a segment before this one, out of which the picture fades in");
    return 0;
  }

  // Returns the seconds after which an event ends a segment, or reports that nobody knows.  The
  // clock must have a rate of its own: any other follows from the duration.
  std::optional<double> read_seconds_until(const Marker& event, const Course& course,
                                           const Item& duration) {
    const auto refuse = [&](const std::string& why) {
      return duration.fail("names the event '" + shown(event.name) + "', " + why);
    };
    const Item* trajectory = course.section.find("trajectory");
    const auto has = [&](const char* key) { return trajectory && peek(*trajectory, key); };
    if (show_.spacetime.is_flat()) return refuse("which needs a black hole");
    if (!(has("rate_m_per_s") || has("time_lapse")) || has("to_r") || has("to_tau_m") ||
        has("orbits"))
      return refuse(
          "whose time would follow from this duration; give the trajectory rate_m_per_s or "
          "time_lapse, and no end");
    // The same rate for so short a time stays within any trajectory.
    constexpr double kTrial = 1e-3;
    const auto motion = read_timed(course, kTrial);
    if (!motion) return std::nullopt;
    const ProperTime& begin = motion->timing.tau_begin;
    const double rate = double(motion->timing.tau_end - begin) / kTrial;
    if (!(rate > 0)) return refuse("but the clock of the segment stands still");
    const auto tau = time_of_event(*event.event, motion->trajectory, begin);
    if (!tau)
      return refuse(event.event->r || event.event->l
                        ? "but its way is never there"
                        : "but its way has no periastron that is known in closed form");
    const double seconds = double(*tau - begin) / rate;
    if (!(seconds > 0)) return refuse("which happens as the segment begins");
    if (seconds > kLongest)
      return refuse(fmt::format("which comes after {} s; at most {} are possible",
                                short_number(seconds), short_number(kLongest)));
    return seconds;
  }

  // Says whether a dissolve is short enough.  At most two segments are seen at a time, so that a
  // dissolve begins after that of the segment before has ended.
  bool fits_dissolve(const Section& section, double dissolve, const Segment& segment) const {
    if (dissolve == 0) return true;
    const Segment& before = segments_.back();
    const double most = std::min(segment.duration_s, before.duration_s - before.dissolve_s);
    if (dissolve <= most) return true;
    const Item& item = *section.find("dissolve_s");
    item.fail(
        fmt::format("must be at most {} (seconds), which is how long this segment and what is left "
                    "of the one before it last, got {}",
                    short_number(most), as_written(item)));
    return false;
  }

  // Returns the values of the show, which hold wherever neither a segment nor a keyframe says
  // otherwise.  A projection whose field of view is fixed has 0 for it.
  PerChannel<double> constants(const Camera& camera) const {
    PerChannel<double> values;
    values[Channel::kRoll] = camera.roll;
    values[Channel::kElevation] = camera.elevation;
    values[Channel::kDomeTilt] = camera.dome_tilt;
    values[Channel::kFov] = field_of_view(show_.projection).value_or(0);
    values[Channel::kEv] = show_.exposure.ev;
    const Cdl& cdl = show_.grade.cdl;
    for (std::size_t k = 0; k < 3; ++k) {
      values[colour_channel(Channel::kSlopeR, k)] = cdl.slope[k];
      values[colour_channel(Channel::kOffsetR, k)] = cdl.offset[k];
      values[colour_channel(Channel::kPowerR, k)] = cdl.power[k];
    }
    values[Channel::kSaturation] = cdl.saturation;
    const Disc disc = show_.disc.value_or(Disc{});
    values[Channel::kDiscLuminance] = disc.luminance;
    values[Channel::kDiscOpacity] = disc.opacity;
    values[Channel::kTitleGain] = values[Channel::kTitleOpacity] = 1;
    for (const SkyRegion region : kEverySky) {
      const RegionSky& sky = show_.sky[region];
      values[gain_channel(region)] = sky.background_gain;
      values[star_gain_channel(region)] = sky.star_gain;
      values[max_magnitude_channel(region)] = sky.stars.value_or(StarField{}).max_magnitude;
    }
    return values;
  }

  // Reads camera, exposure, CDL, skies, disc and bodies.  Each value is taken from the first of these that gives
  // it: the segment's keyframes, the segment, the show's keyframes, the show.
  void read_view(const Section& section, double begin, Segment& segment) {
    CameraKeys own;
    if (const Item* camera = section.find("camera")) own = read_camera(*camera, camera_, lookup_);
    ChannelValues values = read_values(section, show_, [&](SkyRegion region, const Section& keys) {
      read_segment_background(keys, region, lookup_, show_.sky[region],
                              segment.backgrounds[region]);
    });
    lay_over(values, own.values);
    const Magnitudes magnitudes = read_magnitudes(section, show_);
    std::vector<Keyframe> keyframes;
    if (const Item* list = section.find("keyframes"))
      keyframes = read_keyframes(*list, {begin, segment.duration_s}, show_, camera_, lookup_);

    segment.camera = camera_from(laid_over(camera_.keys, own), show_.projection);
    segment.aims = own.attitude || !own.track.empty();
    const PerChannel<double> of_show = constants(camera_from(camera_.keys, show_.projection)),
                             of_segment = constants(segment.camera);
    const auto curve_of = [&](std::optional<double> own_value, const NumberOf& number_of,
                              double in_show, double in_segment) {
      // A value of the segment's own is a constant curve, which hides the show's keyframes.
      const auto curve = own_value ? std::optional(Curve{{{begin, *own_value}}})
                                   : curve_through(keyframes_, number_of, 0, in_show);
      const double base = curve ? value_at(*curve, begin) : in_segment;
      const auto through = curve_through(keyframes, number_of, begin, base);
      return through ? through : curve;
    };
    for (const Channel channel : kEveryChannel)
      segment.curves[channel] = curve_of(
          values[channel], [channel](const Keyframe& keyframe) { return keyframe.values[channel]; },
          of_show[channel], of_segment[channel]);
    for (std::size_t k = 0; k < show_.bodies.size(); ++k)
      segment.magnitudes.push_back(curve_of(
          magnitudes[k], [k](const Keyframe& keyframe) { return keyframe.magnitudes[k]; },
          show_.bodies[k].magnitude, show_.bodies[k].magnitude));
    // A segment whose camera looks somewhere itself is not turned by the show's keyframes.
    const std::vector<AttitudeKey>& track = camera_.keys.track;
    const Attitude first =
        track.empty() ? camera_.keys.attitude.value_or(LookAtHole{}) : track.front().attitude;
    segment.attitudes = own.track;
    if (!own.attitude && own.track.empty()) {
      segment.attitudes = attitudes_through(keyframes_, 0, first);
      if (segment.attitudes.empty()) segment.attitudes = track;
    }
    if (auto through = attitudes_through(keyframes, begin, attitude_at(segment, begin));
        !through.empty())
      segment.attitudes = std::move(through);
  }

  // Returns the attitude of the last keyframe before an instant, from which the segment's own
  // keyframes turn away.
  static Attitude attitude_at(const Segment& segment, double t) {
    Attitude attitude = segment.camera.attitude;
    for (const AttitudeKey& key : segment.attitudes)
      if (key.at_s <= t || &key == segment.attitudes.data()) attitude = key.attitude;
    return attitude;
  }

  // Reads the trajectory of a segment of that duration, or reports why there is none.
  std::optional<TimedTrajectory> read_timed(const Course& course, double duration) {
    const auto& [item, section, begin, moves] = course;
    const Item* trajectory = section.find("trajectory");
    if (!trajectory && show_.spacetime.is_flat())
      return TimedTrajectory{StaticObserver{}, {0, duration}, {}};
    section.require("trajectory", show_.spacetime.is<Wormhole>()
                                      ? ", e.g. {type: infall, from_l: 9, speed: 0.5}"
                                      : ", e.g. {type: infall, from_r: 30}");
    if (!trajectory) return std::nullopt;
    const std::size_t reported = item.problems->count();
    Stage stage{show_.spacetime, axes_before(), duration,
                nullptr,         &show_.bodies, segments_.empty() ? 0 : rain_time(joint_)};
    if (!segments_.empty()) stage.before = &segments_.back();
    // Where the segment before is in error, nothing is known of what goes on with it.
    const auto type = peek(*trajectory, "type");
    if (type && is_word(*type, "continue") && !courses_.empty() && !courses_.back().moves)
      return std::nullopt;
    auto motion = read_trajectory(*trajectory, stage, lookup_);
    // The readers have reported what is wrong.  In any case a segment without motion must not pass.
    if (!motion && item.problems->count() == reported)
      trajectory->fail("leads nowhere that a show can follow");
    return motion;
  }

  // Says whether a segment has a motion.
  bool read_motion(const Course& course, Segment& segment) {
    const auto motion = read_timed(course, segment.duration_s);
    if (!motion) return false;
    const Item* trajectory = course.section.find("trajectory");
    const auto type = trajectory ? peek(*trajectory, "type") : std::nullopt;
    if (type) segment.type = type->node.Scalar();
    if (segment.type == "continue") segment.type = segments_.back().type;
    segment.trajectory = motion->trajectory;
    segment.timing = motion->timing;
    segment.placement = motion->placement;
    return true;
  }

  M33d axes_before() const {
    return segments_.empty() ? place_tetrad(show_.hole_at, show_.heading, 0) : joint_.axes;
  }

  // Reports a camera whose target does not exist in the segment.
  void check_targets(const Item& item, const Segment& segment, double begin) const {
    const double end = begin + segment.duration_s;
    const auto region_at = [&segment](const ProperTime& tau) {
      return point_at(segment.trajectory, tau).region;
    };
    // Nothing returns to region IV, so an observer who ends there has been there throughout.
    const bool sees_no_sky = region_at(segment.timing.tau_begin) == Region::kIV &&
                             region_at(segment.timing.tau_end) == Region::kIV;
    if (sees_no_sky && ever_has<LookAtSky>(segment, begin, end))
      item.fail(
          "has a camera that looks at a place on the sky, but from region IV no sky is seen; give "
          "the segment another camera.look_at");
    if (segment.camera.frame == CameraFrame::kGyroscope)
      if (const std::string why = why_no_gyroscope(show_.spacetime, segment); !why.empty())
        item.fail("has a camera with frame: gyroscope, but " + why);
    if (is_at_rest(segment.trajectory, show_.spacetime) &&
        ever_has<LookAlongMotion>(segment, begin, end))
      item.fail(
          "has a camera that looks along the motion, but its observer does not move; give the "
          "segment another camera.look_at");
  }

  const Show& show_;
  MarkedEvents events_;
  Lookup& lookup_;
  std::vector<Course> courses_;    // of the segments
  std::vector<Segment> segments_;  // that have been read
  Joint joint_;                    // what the next one takes over
  double end_ = 0;
  ShowCamera camera_;
  std::vector<Keyframe> keyframes_;
};

void fail_behind_the_end(const Item& item, double end) {
  item.fail(fmt::format("lies behind the end of the show at {} s, got {}", short_number(end),
                        as_written(item)));
}

void check_keyframes(const Item& list, const std::vector<Keyframe>& keyframes, double end) {
  for (std::size_t k = 0; k < keyframes.size(); ++k)
    if (keyframes[k].at_s > end) fail_behind_the_end(*peek((*read_list(list))[k], "at_s"), end);
}

void check_markers(const Section& section, const std::vector<Marker>& markers, double end) {
  for (const Marker& marker : markers) {
    if (!(marker.at_s > end)) continue;
    const Item& list = *section.find("markers");
    // Markers out of a file have no place of their own in the show.
    fail_behind_the_end(list.node.IsMap() ? *peek(list, marker.name) : list, end);
  }
}

}  // namespace

Fades read_fades(const Section& section) {
  const auto seconds = [&section](std::string_view key) {
    const Item* item = section.find(key);
    return item ? read_time(*item, section.range(key)).value_or(0) : 0;
  };
  return {seconds("fade_in_s"), seconds("fade_out_s")};
}

// The fades may fill the whole duration, and their sum may then exceed it by rounding.
void check_fades(const Section& section, const Fades& fades, double duration, const char* of) {
  if (!(fades.in_s + fades.out_s > duration * (1 + kTimeRounding))) return;
  const Item* last = section.find(fades.out_s > 0 ? "fade_out_s" : "fade_in_s");
  last->fail(fmt::format("makes {} s of fades, but {} lasts {} s",
                         short_number(fades.in_s + fades.out_s), of, short_number(duration)));
}

void read_timeline(const Section& section, const ShowCamera& camera, Lookup& lookup, Show& show) {
  const Item* list = section.require("timeline", ": a list of segments");
  const auto items = list ? read_list(*list) : std::nullopt;
  if (!items) return;
  const std::size_t reported = list->problems->count();
  TimelineReader reader(show, lookup);
  bool fitted = true;
  for (const Item& item : *items) {
    reader.read_way(item);
    const double frames = reader.end() * show.frames_per_second;
    if (fitted && frames > kMostFrames)
      item.fail(fmt::format("brings the show to {} frames; at most {} are possible",
                            short_number(frames), kMostFrames));
    fitted = frames <= kMostFrames;
  }
  // frame_count() would round such a show to no frame at all.
  if (reader.end() * show.frames_per_second < 0.5)
    list->fail(fmt::format(
        "ends after {} s, before half a frame is over; at {} frames per second a frame lasts {} s",
        short_number(reader.end()), short_number(show.frames_per_second),
        short_number(1 / show.frames_per_second)));
  // Where the way has mistakes, an event may be missing because of them.
  if (const Item* markers = section.find("markers"); markers && list->problems->count() == 0)
    report_missing_events(*markers, show.markers);
  ShowCamera named = camera;
  const Item* keyframe_list = section.find("keyframes");
  std::vector<Keyframe> keyframes;
  if (keyframe_list) keyframes = read_keyframes(*keyframe_list, {0, kLongest}, show, named, lookup);
  if (keyframe_list) check_keyframes(*keyframe_list, keyframes, reader.end());
  reader.read_views(named, keyframes);
  if (list->problems->count() == reported) {
    check_markers(section, show.markers, reader.end());
    check_fades(section, show.fades, reader.end(), "the show");
  }
  show.timeline = reader.take();
}

}  // namespace domefall
