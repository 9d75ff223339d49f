#include "pipeline/cli/star_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

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
  // Their place in the file is told where a record is none.
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
  if (!stars.empty()) facts.brightest = stars.front().v, facts.faintest = stars.back().v;
  facts.names = file.names(stars.size());
  return facts;
}

std::string line(const char* name, const std::string& value) {
  std::array<char, 32> label{};
  std::snprintf(label.data(), label.size(), "%-12s ", name);
  return value.empty() ? "" : label.data() + value + "\n";
}

std::string number(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

// As decimals, not as the float's bits written out.
double rounded(double v) { return std::round(v * 1e4) / 1e4; }

}  // namespace

std::string star_page(const StarFile& file) {
  const Facts facts = facts_of(file);
  std::string page =
      line("source", file.text().source) + line("licence", file.text().licence) +
      line("made", file.text().made) + line("epoch", number("J%.2f", file.epoch())) +
      line("stars", with_commas(file.size())) +
      line("V", number("%.2f to ", facts.brightest) + number("%.2f", facts.faintest)) +
      line("names", with_commas(facts.names.size())) +
      line("no colour", with_commas(facts.colourless)) +
      line("moving", with_commas(facts.moving) + ", with a proper motion");
  for (const Count& count : facts.counts)
    page += line(number("V <= %g", count.limit).c_str(), with_commas(count.stars));
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
