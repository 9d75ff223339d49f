#include <fmt/format.h>

#include <array>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/unpacked_file.h"
#include "pipeline/base/utf8.h"
#include "pipeline/sources/stars/catalogue_formats.h"
#include "pipeline/sources/stars/star_colour.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

using nlohmann::json;

// Reads a JSON file, in any of Unicode's encodings and perhaps packed (unpacked_file.h).  Throws
// InputError, "FILE: byte N: ...", where the file is no JSON, and as UnpackedFile does.
json read_json(const std::filesystem::path& file) {
  const UnpackedFile unpacked(require_file(file));
  const std::string bytes = as_utf8(std::string(unpacked.bytes()), file);
  // The parser would report an empty file as damaged at its first byte, which it does not have.
  if (bytes.empty()) throw InputError(file.string() + ": the file is empty");
  try {
    return nlohmann::json::parse(bytes.begin(), bytes.end());
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError(
        fmt::format("{}: byte {}: this is no JSON, or not all of it", file.string(), error.byte));
  } catch (const nlohmann::json::exception&) {  // raised by a number that no double can hold
    throw InputError(file.string() + ": holds a number that cannot be read");
  }
}

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

  std::uint32_t hip() const {
    const double id = number(member(value_, "id"), "id (the Hipparcos number)", 1, kLastHip);
    return static_cast<std::uint32_t>(id);
  }

  // Returns B-V, which the file has as text, or kNoColour where the text is empty or null.
  float colour(const json& value) const {
    if (value.is_null()) return kNoColour;
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

struct Spelling {
  std::string_view sign, text;
};
// The table has the Greek letters, both forms of sigma, and the superscript digits, all in UTF-8.
constexpr std::array<Spelling, 35> kSpellings{
    {{"α", "alpha"},   {"β", "beta"}, {"γ", "gamma"}, {"δ", "delta"}, {"ε", "epsilon"},
     {"ζ", "zeta"},    {"η", "eta"},  {"θ", "theta"}, {"ι", "iota"},  {"κ", "kappa"},
     {"λ", "lambda"},  {"μ", "mu"},   {"ν", "nu"},    {"ξ", "xi"},    {"ο", "omicron"},
     {"π", "pi"},      {"ρ", "rho"},  {"σ", "sigma"}, {"ς", "sigma"}, {"τ", "tau"},
     {"υ", "upsilon"}, {"φ", "phi"},  {"χ", "chi"},   {"ψ", "psi"},   {"ω", "omega"},
     {"¹", "1"},       {"²", "2"},    {"³", "3"},     {"⁴", "4"},     {"⁵", "5"},
     {"⁶", "6"},       {"⁷", "7"},    {"⁸", "8"},     {"⁹", "9"},     {"⁰", "0"}}};

// Returns a text with its signs spelt out in ASCII, as people type the names of stars.
std::string spelt_out(std::string text) {
  for (const auto& [sign, plain] : kSpellings)
    // What replaces a sign holds none, so that the search ends.
    for (std::size_t at = text.find(sign); at != std::string::npos; at = text.find(sign))
      text.replace(at, sign.size(), plain);
  return text;
}

std::string entry_text(const json& entry, const char* key) {
  const auto found = entry.find(key);
  return found != entry.end() && found->is_string() ? found->get<std::string>() : "";
}

std::string designation(const json& entry) {
  std::string label = spelt_out(entry_text(entry, "bayer"));
  if (label.empty()) label = entry_text(entry, "flam");
  const std::string constellation = entry_text(entry, "c");
  return label.empty() || constellation.empty() ? "" : fmt::format("{} {}", label, constellation);
}

std::unordered_map<StarId, std::uint32_t> places_of(const RawCatalogue& catalogue) {
  std::unordered_map<StarId, std::uint32_t> places;
  for (std::uint32_t i = 0; i < catalogue.stars.size(); ++i)
    // Only the brightest star of a number bears it as its identifier (identify_by_hipparcos), so
    // that names go to that one.
    if (catalogue.stars[i].hip != 0) places.emplace(catalogue.stars[i].id, i);
  return places;
}

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

void add_names(RawCatalogue& catalogue, const std::filesystem::path& file) {
  const json document = read_json(file);
  if (!document.is_object())
    throw InputError(
        fmt::format("{}: this is no list of names by Hipparcos number", file.string()));
  const auto places = places_of(catalogue);
  for (const auto& [key, entry] : document.items()) {
    std::uint32_t hip = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), hip);
    if (error != std::errc() || end != key.data() + key.size() || !entry.is_object())
      throw InputError(fmt::format("{}: '{}': this is no Hipparcos number with names",
                                   file.string(), key.substr(0, 40)));
    const auto found = places.find(hipparcos_id(hip));
    if (found == places.end()) continue;
    for (const std::string& name : {entry_text(entry, "name"), designation(entry)})
      if (!name.empty()) catalogue.names.push_back({found->second, name});
  }
}

}  // namespace domefall
