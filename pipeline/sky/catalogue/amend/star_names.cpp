#include "pipeline/sky/catalogue/amend/star_names.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <unordered_map>

#include "pipeline/image/errors.h"
#include "pipeline/sky/catalogue/import/json_file.h"

namespace domefall {
namespace {

using nlohmann::json;

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

// Returns the text of a key, or an empty text if the entry has none.
std::string entry_text(const json& entry, const char* key) {
  const auto found = entry.find(key);
  return found != entry.end() && found->is_string() ? found->get<std::string>() : "";
}

// Returns the Bayer designation or, for a star without one, that of Flamsteed.
std::string designation(const json& entry) {
  std::string label = spelt_out(entry_text(entry, "bayer"));
  if (label.empty()) label = entry_text(entry, "flam");
  const std::string constellation = entry_text(entry, "c");
  return label.empty() || constellation.empty() ? "" : fmt::format("{} {}", label, constellation);
}

// Returns the indices of the stars that bear Hipparcos numbers.
std::unordered_map<StarId, std::uint32_t> places_of(const RawCatalogue& catalogue) {
  std::unordered_map<StarId, std::uint32_t> places;
  for (std::uint32_t i = 0; i < catalogue.stars.size(); ++i)
    // Only the brightest star of a number bears it as its identifier (identify_by_hipparcos), so
    // that names go to that one.
    if (catalogue.stars[i].hip != 0) places.emplace(catalogue.stars[i].id, i);
  return places;
}

}  // namespace

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
