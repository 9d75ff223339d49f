#include <fmt/format.h>

#include <charconv>

#include "pipeline/image/errors.h"
#include "pipeline/sky/catalogue/import/catalogue_formats.h"
#include "pipeline/sky/catalogue/import/json_file.h"
#include "pipeline/sky/catalogue/star_colour.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

using nlohmann::json;

// A feature is one star of the list.  It knows its index for messages.
class Feature {
 public:
  Feature(const std::filesystem::path& file, std::size_t index, const json& value)
      : file_(file), index_(index), value_(value) {}

  CatalogueStar star() const {
    CatalogueStar out;
    out.hip = hip();
    out.id = hipparcos_id(out.hip);
    // A position of GeoJSON is longitude and latitude in this order (RFC 7946, sec. 3.1.1).
    const json& place = member(member(value_, "geometry"), "coordinates");
    if (!place.is_array() || place.size() != 2) fail("coordinates must be [RA, Dec]");
    // GeoJSON has longitudes from -180 to 180 degrees, and RA is negative beyond 180.
    const double ra = number(place[0], "RA", -180, 360);
    out.direction = sky_direction(ra < 0 ? ra + 360 : ra, number(place[1], "Dec", -90, 90));
    const json& properties = member(value_, "properties");
    out.v = static_cast<float>(number(member(properties, "mag"), "mag", kBrightestV, kFaintestV));
    out.colour = colour(member(properties, "bv"));
    return out;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: features[{}]: {}", file_.string(), index_, what));
  }

  // Returns a member of an object, and throws InputError where there is none or no object.
  const json& member(const json& of, const char* name) const {
    const auto found = of.is_object() ? of.find(name) : of.end();
    if (!of.is_object() || found == of.end()) fail(fmt::format("has no {}", name));
    return *found;
  }

  double number(const json& value, const char* name, double low, double high) const {
    // A value that is no number becomes one beyond the range, so that one test refuses both.
    const double number = value.is_number() ? value.get<double>() : high + 1;
    if (!(number >= low && number <= high))
      fail(fmt::format("{} must be a number from {:.12g} to {:.12g}", name, low, high));
    return number;
  }

  // Returns the Hipparcos number, which is the id of the feature.
  std::uint32_t hip() const {
    const double id = number(member(value_, "id"), "id (the Hipparcos number)", 1, kLastHip);
    return static_cast<std::uint32_t>(id);
  }

  // Returns B-V, which the file has as text, or kNoColour where the text is empty.
  float colour(const json& value) const {
    if (!value.is_string()) fail("bv must be a number in quotes, or empty quotes");
    const auto& text = value.get_ref<const std::string&>();
    if (text.empty()) return kNoColour;
    double b_v = 0;
    // The test of the range is negated, so that it refuses the text nan as well.
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), b_v);
    if (error != std::errc() || end != text.data() + text.size() || !(std::abs(b_v) <= kReddest))
      fail("bv must be a number in quotes, or empty quotes");
    return colour_of_b_v(b_v);
  }

  const std::filesystem::path& file_;
  std::size_t index_;
  const json& value_;
};

}  // namespace

ImportedCatalogue import_d3_celestial(const Paths& inputs) {
  ImportedCatalogue out;
  for (const std::filesystem::path& input : inputs) {
    const json document = read_json(input);
    // GeoJSON calls such a file a feature collection, whose members stand under `features`.
    const auto features = document.is_object() ? document.find("features") : document.end();
    if (!document.is_object() || features == document.end() || !features->is_array())
      throw InputError(input.string() + ": this is no list of stars (GeoJSON with features)");
    std::size_t index = 0;
    for (const json& feature : *features)
      out.catalogue.stars.push_back(Feature(input, index++, feature).star());
  }
  out.catalogue.text = {
      "d3-celestial, (c) 2015 Olaf Frohn, from XHIP (Anderson & Francis 2012) and ESA's Hipparcos",
      "BSD-3-Clause", ""};
  return out;
}

}  // namespace domefall
