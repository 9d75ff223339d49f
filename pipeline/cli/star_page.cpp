#include "pipeline/cli/star_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "pipeline/sky/catalogue/count_text.h"
#include "pipeline/sky/catalogue/read_star_catalogue.h"

namespace domefall {
namespace {

constexpr int kFirstLimit = -1, kLastLimit = 20;

struct Count {
  double limit;
  std::size_t stars;  // of V <= limit
};

struct Facts {
  std::vector<Count> counts;  // from the first limit that a star meets to the one that all meet
  std::size_t colourless = 0, moving = 0;
  double brightest = 0, faintest = 0;
  std::vector<StarName> names;
};

Facts facts_of(const StarFile& file) {
  // Making stars of all records throws an error that names the byte of a record that is no star.
  stars_of(file, std::numeric_limits<double>::infinity(), file.epoch());
  const auto stars = file.up_to(std::numeric_limits<double>::infinity());
  Facts facts;
  std::vector<double> limits;
  for (int v = kFirstLimit; v <= kLastLimit; ++v) limits.push_back(v);
  limits.insert(std::find(limits.begin(), limits.end(), 7.0), 6.5);
  for (const double limit : limits) {
    const std::size_t met = file.up_to(limit).size();
    if (met > 0) facts.counts.push_back({limit, met});
    if (met == stars.size()) break;
  }
  for (const StarRecord& star : stars) {
    if (star.colour == kNoColour) ++facts.colourless;
    if (star.pm_ra != 0 || star.pm_dec != 0) ++facts.moving;
  }
  if (!stars.empty()) {
    facts.brightest = stars.front().v;
    facts.faintest = stars.back().v;
  }
  facts.names = file.names(stars.size());
  return facts;
}

std::string line(std::string_view name, const std::string& value) {
  return value.empty() ? "" : fmt::format("{:12} {}\n", name, value);
}

// Returns a magnitude without the decimals that a float adds to it.
double rounded(double v) { return std::round(v * 1e4) / 1e4; }

}  // namespace

std::string star_page(const StarFile& file) {
  const Facts facts = facts_of(file);
  std::string page =
      line("source", file.text().source) + line("licence", file.text().licence) +
      line("made", file.text().made) + line("epoch", fmt::format("J{:.2f}", file.epoch())) +
      line("stars", with_commas(file.size())) +
      line("V", fmt::format("{:.2f} to {:.2f}", facts.brightest, facts.faintest)) +
      line("names", with_commas(facts.names.size())) +
      line("no colour", with_commas(facts.colourless)) +
      line("moving", fmt::format("{}, with a proper motion", with_commas(facts.moving)));
  for (const Count& count : facts.counts)
    page += line(fmt::format("V <= {:g}", count.limit), with_commas(count.stars));
  return page;
}

std::string star_json(const StarFile& file) {
  const Facts facts = facts_of(file);
  nlohmann::ordered_json json = {{"source", file.text().source},
                                 {"licence", file.text().licence},
                                 {"made", file.text().made},
                                 {"epoch", file.epoch()},
                                 {"stars", file.size()},
                                 {"names", facts.names.size()},
                                 {"brightest_v", rounded(facts.brightest)},
                                 {"faintest_v", rounded(facts.faintest)},
                                 {"without_colour", facts.colourless},
                                 {"with_proper_motion", facts.moving},
                                 {"fingerprint", file.fingerprint()}};
  json["counts"] = nlohmann::ordered_json::array();
  for (const Count& count : facts.counts)
    json["counts"].push_back({{"v_up_to", count.limit}, {"stars", count.stars}});
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace domefall
