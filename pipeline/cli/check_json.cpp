#include <cmath>
#include <cstdio>
#include <string_view>

#include "pipeline/cli/check_page.h"

namespace domefall {
namespace {

// Writes values with the commas and quotes that they need.
class Json {
 public:
  template <class Inside>
  void object(std::string_view name, const Inside& inside) {
    enclose(name, '{', '}', inside);
  }
  template <class Inside>
  void array(std::string_view name, const Inside& inside) {
    enclose(name, '[', ']', inside);
  }
  // name: empty within an array.
  void value(std::string_view name, double number) {
    char text[32] = "null";
    if (std::isfinite(number)) std::snprintf(text, sizeof text, "%.12g", number);
    put(name, text);
  }
  void value(std::string_view name, std::string_view text) { put(name, quoted(text)); }
  void null(std::string_view name) { put(name, "null"); }

  const std::string& text() const { return text_; }

 private:
  static std::string quoted(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
      char escaped[8];
      if (c == '"' || c == '\\') {
        out += '\\', out += c;
      } else if (static_cast<unsigned char>(c) < 0x20) {
        std::snprintf(escaped, sizeof escaped, "\\u%04x", static_cast<unsigned>(c));
        out += escaped;
      } else {
        out += c;
      }
    }
    return out + '"';
  }

  void put(std::string_view name, std::string_view value) {
    if (!first_) text_ += ", ";
    first_ = false;
    if (!name.empty()) text_ += quoted(name) + ": ";
    text_ += value;
  }

  template <class Inside>
  void enclose(std::string_view name, char open, char close, const Inside& inside) {
    put(name, std::string(1, open));
    first_ = true;
    inside();
    text_ += close;
    first_ = false;
  }

  std::string text_;
  bool first_ = true;
};

class Writer {
 public:
  explicit Writer(const CheckReport& report) : r_(report), show_(report.show) {}

  std::string text() {
    json_.object("", [this] {
      head();
      json_.array("segments", [this] {
        for (const SegmentSurvey& s : r_.survey.segments) segment(s);
      });
      json_.array("joints", [this] {
        for (const SegmentJoint& j : r_.joints) joint(j);
      });
      whole();
      json_.array("warnings", [this] {
        for (const ShowWarning& w : r_.warnings) warning(w);
      });
    });
    return json_.text() + "\n";
  }

 private:
  void head() {
    json_.value("title", show_.title);
    json_.value("frames", frame_count(show_));
    json_.value("frames_per_second", show_.frames_per_second);
    json_.value("duration_s", segment_times(show_).back());
    json_.value("projection", projection_name(show_.projection));
    json_.value("width", columns(show_.projection));
    json_.value("height", rows(show_.projection));
    if (r_.display.empty()) {
      json_.null("display"), json_.null("view");
    } else {
      json_.value("display", r_.display), json_.value("view", r_.view);
    }
    if (show_.mass_solar)
      json_.value("mass_solar", *show_.mass_solar);
    else
      json_.null("mass_solar");
  }

  void regions(const std::vector<Region>& regions) {
    json_.array("regions", [&] {
      for (const Region region : regions) json_.value("", region_name(region));
    });
  }

  void extreme(const char* name, const std::optional<Extreme>& e, double value) {
    if (!e) return json_.null(name);
    json_.object(name, [&] {
      json_.value("value", value), json_.value("time_s", e->time_s);
      json_.value("frame", e->frame), json_.value("segment", e->segment);
    });
  }
  void extreme(const char* name, const std::optional<Extreme>& e) {
    extreme(name, e, e ? e->value : 0);
  }

  void segment(const SegmentSurvey& s) {
    const bool hole = show_.mass_solar.has_value();
    json_.object("", [&] {
      json_.value("type", s.type);
      json_.value("begin_s", s.begin_s), json_.value("end_s", s.end_s);
      json_.value("dissolve_s", s.dissolve_s);
      json_.value("from_r", s.r_begin), json_.value("to_r", s.r_end);
      extreme("closest", hole ? std::optional(s.closest) : std::nullopt);
      if (hole) regions(s.regions);
      if (hole) json_.value("proper_time_m", s.proper_time);
      json_.value("proper_time_s",
                  s.proper_time * (hole ? *show_.mass_solar * kSecondsPerSolarMass : 1));
      const char* unit = hole ? "rate_m_per_s" : "time_lapse";
      json_.array(unit, [&] { json_.value("", s.rate_begin), json_.value("", s.rate_end); });
    });
  }

  void joint(const SegmentJoint& j) {
    json_.object("", [&] {
      json_.value("segment", j.segment), json_.value("time_s", j.time_s);
      json_.value("dissolve_s", j.dissolve_s);
      json_.value("r_before", j.r_before), json_.value("r_after", j.r_after);
      json_.value("region_before", region_name(j.region_before));
      json_.value("region_after", region_name(j.region_after));
      if (j.speed)
        json_.value("velocity_jump", *j.speed);
      else
        json_.null("velocity_jump");
      json_.value("rate_before", j.rate_before), json_.value("rate_after", j.rate_after);
    });
  }

  void light(const char* name, const FrameLight& l) {
    json_.object(name, [&] {
      json_.value("frame", l.frame), json_.value("time_s", l.time_s);
      json_.value("segment", l.segment), json_.value("ev", l.ev);
      json_.value("mean", l.mean), json_.value("percentile_99", l.percentile99);
      json_.value("part_at_white", l.white);
    });
  }

  void whole() {
    if (show_.mass_solar) regions(r_.survey.regions);
    extreme("closest_r", r_.survey.closest);
    const auto& fastest = r_.survey.fastest;
    const double celerity = fastest ? fastest->value : 0;
    extreme("fastest_speed", fastest, celerity / std::hypot(1.0, celerity));
    extreme("fastest_lorentz_factor", fastest, std::hypot(1.0, celerity));
    extreme("least_one_plus_z", r_.survey.bluest);
    extreme("largest_one_plus_z", r_.survey.reddest);
    light("brightest", r_.light.brightest), light("darkest", r_.light.darkest);
    if (!r_.time) return json_.null("render");
    json_.object("render", [this] {
      json_.value("seconds", r_.time->seconds), json_.value("frame_s", r_.time->frame_s);
      json_.value("threads", r_.time->threads);
    });
  }

  void warning(const ShowWarning& w) {
    json_.object("", [&] {
      json_.value("time_s", w.time_s), json_.value("frame", w.frame);
      json_.value("segment", w.segment), json_.value("text", w.text);
    });
  }

  const CheckReport& r_;
  const Show& show_;
  Json json_;
};

}  // namespace

std::string check_json(const CheckReport& report) { return Writer(report).text(); }

}  // namespace domefall
