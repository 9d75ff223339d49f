#include "pipeline/program/cli/check_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/base/frame_rate.h"
#include "pipeline/base/ratio.h"
#include "pipeline/base/talk.h"
#include "pipeline/base/utf8.h"
#include "pipeline/grade/grader.h"
#include "pipeline/render/scene/exposure.h"
#include "pipeline/show/file/show_time.h"
#include "pipeline/show/observer_track.h"

namespace domefall {
namespace {

class Page {
 public:
  explicit Page(const CheckReport& report) : r_(report), show_(report.show) {}

  std::string text() {
    head();
    fades(show_.fades, "fading");
    markers();
    skies();
    effects();
    for (std::size_t k = 0; k < r_.survey.segments.size(); ++k) segment(k);
    whole();
    light();
    time();
    disk();
    warnings();
    return text_;
  }

 private:
  void line(const std::string& name, const std::string& text) {
    text_ += fmt::format("{:<12} {}\n", name, printable(text));
  }

  void head() {
    line("title", show_.title);
    const FrameRate rate = frame_rate_of(show_.frames_per_second);
    const double aspect = pixel_aspect(show_.projection);
    line("frames", fmt::format("{} at {} a second ({:.6g} s), {} of {} x {}{}", frame_count(show_),
                               rate_text(rate), segment_times(show_).back(),
                               projection_name(show_.projection), columns(show_.projection),
                               rows(show_.projection),
                               aspect == 1 ? "" : " pixels of " + ratio_text(aspect)));
    if (show_.written_rate)
      line("rate", fmt::format("{:g} is taken for {}, the rate of video that it stands for",
                               *show_.written_rate, text_of(rate)));
    if (r_.display.empty())
      line("graded for", "nothing: scene-linear frames alone");
    else
      line("graded for", r_.display + ", " + r_.view);
    if (const std::string note = ocio_note(show_.grade); !note.empty() && show_.output.graded)
      line("", note);
    if (const auto mass = show_.spacetime.solar_masses()) {
      line("black hole", fmt::format("{:.6g} solar masses: 1 M lasts {}", *mass,
                                     duration_text(show_.spacetime.seconds_per_m())));
    } else if (const auto* wormhole = std::get_if<Wormhole>(&show_.spacetime.kind())) {
      line("wormhole",
           fmt::format("{:.6g} km radius of its throat, which light takes {} for",
                       wormhole->radius_km, duration_text(show_.spacetime.seconds_per_m())));
      line("", wormhole->profile == Wormhole::Profile::kEllis
                   ? "profile ellis"
                   : fmt::format("profile dngr, length {:.6g} and lensing width {:.6g} radii",
                                 wormhole->length, wormhole->lensing_width));
    } else {
      line("black hole", "none: flat space");
    }
    if (const auto* spinning = std::get_if<SpinningHole>(&show_.spacetime.kind())) {
      std::string text = fmt::format("{:.6g}", static_cast<double>(spinning->kerr.spin));
      if (spinning->kerr.charge > 0)
        text += fmt::format(", and a charge of {:.6g}", static_cast<double>(spinning->kerr.charge));
      line("spin", fmt::format("{}: horizons at r = {:.6g} M and {:.6g} M", text,
                               spinning->horizon(), spinning->inner_horizon()));
    }
    const auto* hole = std::get_if<ChargedHole>(&show_.spacetime.kind());
    if (hole && hole->is_naked())
      line("charge",
           fmt::format("{:.6g} of its mass: a naked singularity, without a horizon", hole->charge));
    else if (hole)
      line("charge", fmt::format("{:.6g} of its mass: horizons at r = {:.6g} M and {:.6g} M",
                                 hole->charge, hole->horizon(), hole->inner_horizon()));
  }

  void skies() {
    for (const auto& [sky, black] : r_.skies) {
      std::string text;
      if (!sky.map.empty()) add(text, sky.map);
      if (sky.map_fainter_than)
        text += fmt::format(", the light of stars fainter than V = {:g}", *sky.map_fainter_than);
      if (!sky.catalogue.empty())
        add(text, fmt::format("{}, {} to V = {:.3g}", sky.catalogue, counted(sky.stars, "star"),
                              sky.faintest));
      if (sky.planets_year) text += fmt::format(", and the planets of {}", *sky.planets_year);
      if (text.empty()) continue;
      line(sky.region == SkyRegion::kI      ? "sky"
           : sky.region == SkyRegion::kNext ? "next sky"
                                            : fmt::format("region {}", name_of(sky.region)),
           text + segments_text(sky));
      if (!sky.taken.empty()) line("", sky.map + " is taken as: " + sky.taken);
    }
  }

  // Says what the frames leave out of nature, or add to it.
  void effects() {
    const Effects& e = show_.effects;
    if (e == Effects{}) return;
    std::string text;
    if (!e.aberration) text += "no aberration; ";
    if (!e.doppler_colour) text += "no Doppler colours; ";
    if (!e.intensity) text += "intensities at rest; ";
    if (!e.lensing) text += "no lensing; ";
    constexpr const char* kAmplified[] = {"nothing is", "stars are", "everything is"};
    line("effects", text + kAmplified[static_cast<int>(e.amplification)] + " amplified");
  }

  static std::string regions_text(const std::vector<Visit>& visits) {
    constexpr std::size_t kMost = 12;
    std::vector<std::string> names;
    for (std::size_t k = 0; k < visits.size() && k < kMost; ++k)
      names.push_back(region_name(visits[k].region, visits[k].universe));
    if (visits.size() > kMost) names.emplace_back("...");
    return fmt::format("{}", fmt::join(names, ", "));
  }

  // Returns the unit of lengths and proper times: seconds, M, or radii of a wormhole's throat.
  const char* unit() const {
    return show_.spacetime.is_flat() ? "s" : show_.spacetime.is<Wormhole>() ? "radii" : "M";
  }

  std::string proper_time(double span) const {
    if (show_.spacetime.is_flat()) return duration_text(span);
    return fmt::format("{:.6g} {} ({})", span, unit(),
                       duration_text(span * show_.spacetime.seconds_per_m()));
  }

  std::string rate(const SegmentSurvey& s) const {
    const double mean = s.proper_time / (s.end_s - s.begin_s);
    const bool steady = std::abs(s.rate_end - s.rate_begin) <= 1e-3 * std::abs(mean) &&
                        std::abs(s.rate_end - mean) <= 1e-3 * std::abs(mean);
    return steady ? fmt::format("{:.4g} {} a second", mean, unit())
                  : fmt::format("{:.4g} {} a second ({:.4g} at first, {:.4g} at last)", mean,
                                unit(), s.rate_begin, s.rate_end);
  }

  void segment(std::size_t k) {
    const SegmentSurvey& s = r_.survey.segments[k];
    if (k > 0) joint(r_.joints[k - 1]);
    line(fmt::format("segment {}", k + 1),
         fmt::format("{}, {:.6g} s to {:.6g} s", s.type, s.begin_s, s.end_s));
    std::string text = "flat space; ";
    if (!show_.spacetime.is_flat()) {
      const bool wormhole = show_.spacetime.is<Wormhole>();
      text = wormhole
                 ? fmt::format("l = {:.6g} {} to {:.6g} {}", s.l_begin, unit(), s.l_end, unit())
                 : fmt::format("r = {:.6g} {} to {:.6g} {}", s.r_begin, unit(), s.r_end, unit());
      if (s.closest.value < std::min(s.r_begin, s.r_end) * (1 - 1e-6))
        text += fmt::format(", closest {}{:.6g} {} at {:.5g} s", wormhole ? "r = " : "",
                            s.closest.value, unit(), s.closest.time_s);
      line("", text + "; region " + regions_text(s.visits));
      text.clear();
    }
    line("", text + proper_time(s.proper_time) + " of proper time, " + rate(s));
    fades(segment_of(show_, static_cast<int>(k)).fades, "");
  }

  static void add(std::string& list, const std::string& text) {
    list += (list.empty() ? "" : "; ") + text;
  }

  void joint(const SegmentJoint& j) {
    std::string changes;
    if (j.before != j.after)
      add(changes, fmt::format("region {} to {}", region_name(j.before.region, j.before.universe),
                               region_name(j.after.region, j.after.universe)));
    if (j.place_jumps() && j.r_before != j.r_after)
      add(changes, fmt::format("r jumps from {:.6g} {} to {:.6g} {}", j.r_before, unit(), j.r_after,
                               unit()));
    if (j.velocity_jumps())
      add(changes, fmt::format("velocity jumps by {:.4g} of light's", *j.speed));
    if (changes.empty()) changes = "the motion goes on";
    const std::string name = j.dissolve_s > 0 ? fmt::format("dissolve of {:.4g} s", j.dissolve_s)
                             : j.place_jumps() || j.velocity_jumps() ? "cut"
                                                                     : "joint";
    line("", fmt::format("-- {} at {:.6g} s: ", name, j.time_s) + changes);
  }

  static std::string place(const Extreme& e) {
    return fmt::format("frame {} ({:.5g} s)", e.frame, e.time_s);
  }

  void black() {
    for (const auto& [sky, level] : r_.skies) {
      if (!level) continue;
      const char* by = sky.panorama->black ? "as the show says" : "the map's own darkest 1 %";
      line(fmt::format("black of {}", name_of(sky.region)),
           fmt::format("{:.3g} cd/m^2, {}, {:.3g} as a pixel value at 0 EV{}", *level, by,
                       *level / kReferenceLuminance, segments_text(sky)));
    }
  }

  void whole() {
    text_ += "\nthe whole show\n";
    if (!show_.spacetime.is_flat()) line("regions", regions_text(r_.survey.visits));
    black();
    if (const auto& e = r_.survey.closest)
      line("closest", fmt::format("r = {:.6g} {}, ", e->value, unit()) + place(*e));
    if (const auto& e = r_.survey.fastest; e && e->value > 1e-12) {
      const double gamma = std::hypot(1.0, e->value);
      line("fastest",
           fmt::format("{:.6g} of light's speed (Lorentz factor {:.5g}) against who is at rest "
                       "there{}, ",
                       e->value / gamma, gamma,
                       show_.spacetime.is<SpinningHole>()
                           ? ", that is who has no angular momentum and turns with space"
                           : "") +
               place(*e));
    }
    if (const auto& e = r_.survey.bluest)
      line("bluest sky", fmt::format("1 + z = {:.5g}, ", e->value) + place(*e));
    if (const auto& e = r_.survey.reddest)
      line("reddest sky", fmt::format("1 + z = {:.5g}, ", e->value) + place(*e));
  }

  void light_line(const char* name, const FrameLight& light) {
    std::string text =
        fmt::format("frame {} ({:.5g} s), segment {}: mean luminance {:.3g}, 99 % below {:.3g}",
                    light.frame, light.time_s, light.segment + 1, light.mean, light.percentile99);
    constexpr double kMuch = 0.03;
    if (light.white > kMuch)
      text += fmt::format("; {:.0f} % of the pixels at or beyond white", 100 * light.white);
    line(name, text);
  }

  void light() {
    light_line("brightest", r_.light.brightest);
    if (r_.light.darkest.frame != r_.light.brightest.frame) light_line("darkest", r_.light.darkest);
  }

  void time() {
    if (!r_.time)
      return line("to render", is_worth_measuring(show_)
                                   ? "not measured: no temporary file can be written"
                                   : "not measured: to render the show is almost as quick");
    line("to render",
         fmt::format("about {} on this machine with {} thread{} at {} x {} ({:.3g} s a frame)",
                     duration_text(r_.time->seconds), r_.time->threads,
                     r_.time->threads == 1 ? "" : "s", columns(show_.projection),
                     rows(show_.projection), r_.time->frame_s));
  }

  void disk() {
    const DiskSize size = disk_size(r_);
    std::string text = fmt::format("{} {}: {} frames of {}", size.measured ? "about" : "at most",
                                   bytes_text(size.total()), size.frames,
                                   bytes_text(size.linear > 0 ? size.linear : size.graded));
    text += size.linear > 0 ? " scene-linear" : " graded";
    if (size.linear > 0 && size.graded > 0)
      text += fmt::format(" and {} graded", bytes_text(size.graded));
    if (r_.room)
      text += fmt::format("; {} free at {}", bytes_text(r_.room->free), r_.room->folder.string());
    line("on disk", text);
  }

  void markers() {
    for (const Marker& marker : show_.markers) {
      const int frame = nearest_frame(show_, marker.at_s);
      line("marker", fmt::format("{} at {} ({:.6g} s), frame {}, segment {}", marker.name,
                                 clock_text(marker.at_s), marker.at_s, frame,
                                 segment_at(show_, marker.at_s) + 1));
    }
  }

  void fades(const Fades& fades, const char* name) {
    std::string text;
    if (fades.in_s > 0) add(text, fmt::format("fades in for {:.6g} s", fades.in_s));
    if (fades.out_s > 0) add(text, fmt::format("fades out for {:.6g} s", fades.out_s));
    if (!text.empty()) line(name, text);
  }

  void warnings() {
    if (r_.warnings.empty()) {
      text_ += "\nno warnings\n";
      return;
    }
    // An orbit that passes through for ever warns of the same at each passage.
    std::vector<std::pair<ShowWarning, int>> kinds;
    for (const ShowWarning& w : r_.warnings) {
      const auto same =
          std::ranges::find(kinds, w.text, [](const auto& k) { return k.first.text; });
      if (same == kinds.end())
        kinds.emplace_back(w, 1);
      else
        ++same->second;
    }
    constexpr std::size_t kMost = 20;
    text_ += "\nwarnings\n";
    for (std::size_t k = 0; k < kinds.size() && k < kMost; ++k) {
      const auto& [w, times] = kinds[k];
      if (w.segment == kWholeShow)
        text_ += "the whole show: ";
      else
        text_ += fmt::format("{:8.5g} s, frame {}, segment {}{}: ", w.time_s, w.frame,
                             w.segment + 1, times > 1 ? fmt::format(", first of {}", times) : "");
      text_ += printable(w.text) + "\n";
    }
    if (kinds.size() > kMost) text_ += fmt::format("  and {} more\n", kinds.size() - kMost);
  }

  const CheckReport& r_;
  const Show& show_;
  std::string text_;
};

}  // namespace

std::string duration_text(double seconds) {
  struct Unit {
    double from, seconds;
    const char* name;
  };
  constexpr double kMinute = 60, kHour = 3600, kDay = 86400, kYear = 31557600;
  constexpr Unit kUnits[] = {{2 * kYear, kYear, "years"},
                             {2 * kDay, kDay, "days"},
                             {2 * kHour, kHour, "h"},
                             {2 * kMinute, kMinute, "min"},
                             {0.1, 1, "s"},
                             {1e-4, 1e-3, "ms"},
                             {0, 1e-6, "us"}};
  for (const Unit& unit : kUnits)
    if (std::abs(seconds) >= unit.from)
      return fmt::format("{:.3g} {}", seconds / unit.seconds, unit.name);
  return fmt::format("{:g} s", seconds);
}

std::string check_page(const CheckReport& report) { return Page(report).text(); }

}  // namespace domefall
