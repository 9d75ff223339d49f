#include "pipeline/sources/stars/amend_catalogue.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "pipeline/base/csv_file.h"
#include "pipeline/sources/stars/raw_catalogue.h"
#include "pipeline/sources/stars/star_catalogue.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

// A removed star has this magnitude until all rows are applied, so that the indices of the other
// stars stay the same.  It lies beyond every limit, and keep_brighter() drops it at the end.
constexpr float kRemoved = 2 * kNoMagnitude;

// Returns the parts between the bars of "HD 174638 | HIP 92420".
std::vector<std::string_view> alternatives(std::string_view cell) {
  std::vector<std::string_view> found;
  for (;;) {
    const std::size_t bar = cell.find('|');
    found.push_back(cell.substr(0, bar));
    if (bar == std::string_view::npos) return found;
    cell.remove_prefix(bar + 1);
  }
}

class Corrections {
 public:
  // Lists the stars by identifier and by name, and marks each name that several stars have.
  Corrections(RawCatalogue& catalogue, const std::filesystem::path& file)
      : catalogue_(catalogue), row_(file, {"star"}) {
    for (std::uint32_t i = 0; i < catalogue.stars.size(); ++i)
      if (catalogue.stars[i].id != kNoStarId) by_id_.emplace(catalogue.stars[i].id, i);
    for (const StarName& name : catalogue.names) {
      const auto [at, first] = by_name_.emplace(folded_star_name(name.name), name.star);
      if (!first && at->second != name.star) ambiguous_.insert(at->first);
    }
  }

  // Applies all rows and returns their number.
  std::size_t apply() {
    std::size_t rows = 0;
    for (; row_.next(); ++rows) {
      const std::string_view action = row_.text("action");
      if (action == "add")
        add();
      else if (action == "remove")
        remove(wanted_once());
      else if (action.empty())
        change(wanted_once());
      else
        row_.fail(fmt::format("action must be add, remove or empty, got '{}'", action));
    }
    // Stars that still have no magnitude stay, since kNoMagnitude itself is within the limit.
    keep_brighter(catalogue_, kNoMagnitude);
    return rows;
  }

 private:
  // Returns the index of the star with this identifier or name, or nothing if the catalogue has
  // none.
  std::optional<std::uint32_t> find(std::string_view alternative) const {
    if (const auto id = parse_star_id(alternative)) {
      const auto found = by_id_.find(*id);
      if (found != by_id_.end()) return found->second;
    }
    const auto found = by_name_.find(folded_star_name(alternative));
    if (found != by_name_.end() && ambiguous_.contains(found->first))
      row_.fail(fmt::format("several stars are called '{}'; name its number", alternative));
    return found == by_name_.end() ? std::nullopt : std::optional(found->second);
  }

  // Returns the star of the row: that of the first alternative that is there and not removed.
  CatalogueStar& wanted() {
    const std::string_view cell = row_.text("star");
    if (folded_star_name(cell).empty()) row_.fail("star is empty");
    for (const std::string_view alternative : alternatives(cell)) {
      const auto place = find(alternative);
      if (place && catalogue_.stars[*place].v != kRemoved) return catalogue_.stars[*place];
    }
    row_.fail(fmt::format("the catalogue has no star '{}'", cell));
  }

  // A second row about a star is refused, because it would undo the first without a word.
  CatalogueStar& wanted_once() {
    CatalogueStar& star = wanted();
    if (!seen_.insert(&star - catalogue_.stars.data()).second)
      row_.fail(fmt::format("the star '{}' is corrected twice", row_.text("star")));
    return star;
  }

  // Gives the star the numbers of the row and says whether there were any.  All cells are checked
  // before the first is taken.
  bool take_numbers(CatalogueStar& star) {
    const auto v = row_.number("v_mag", kBrightestV, kFaintestV);
    const auto b_v = row_.number("b_v", kBluest, kReddest);
    const auto temperature = row_.number("temperature_k", kColdest, kHottest);
    if (b_v && temperature) row_.fail("b_v and temperature_k exclude each other");
    const auto ra = row_.number("ra_deg", 0, 360), dec = row_.number("dec_deg", -90, 90);
    const auto pm_ra = row_.number("pm_ra_mas_yr", -kFastest, kFastest);
    const auto pm_dec = row_.number("pm_dec_mas_yr", -kFastest, kFastest);
    if (ra.has_value() != dec.has_value())
      row_.fail("ra_deg and dec_deg are given both or neither");
    if (pm_ra.has_value() != pm_dec.has_value())
      row_.fail("pm_ra_mas_yr and pm_dec_mas_yr are given both or neither");
    if (v) star.v = static_cast<float>(*v);
    if (b_v) star.colour = static_cast<float>(*b_v);
    if (temperature) star.colour = static_cast<float>(*temperature);
    if (ra) star.direction = sky_direction(*ra, *dec);
    if (pm_ra) {
      star.pm_ra = static_cast<float>(*pm_ra);
      star.pm_dec = static_cast<float>(*pm_dec);
    }
    return v || b_v || temperature || ra || pm_ra;
  }

  void change(CatalogueStar& star) {
    if (!take_numbers(star)) row_.fail("the row changes nothing");
  }

  // Marks a star as removed.  Numbers in such a row would be a mistake.
  void remove(CatalogueStar& star) {
    CatalogueStar other;
    if (take_numbers(other)) row_.fail("a star that is removed has no numbers");
    star.v = kRemoved;
  }

  void add() {
    CatalogueStar star;
    const std::string_view cell = row_.text("star");
    star.id = parse_star_id(cell).value_or(kNoStarId);
    for (const std::string_view alternative : alternatives(cell))
      if (find(alternative)) row_.fail(fmt::format("the catalogue has a star '{}' already", cell));
    // take_numbers() allows these cells to be empty, but a new star needs them.
    row_.required("ra_deg", 0, 360);
    row_.required("dec_deg", -90, 90);
    row_.required("v_mag", kBrightestV, kFaintestV);
    take_numbers(star);
    const auto place = static_cast<std::uint32_t>(catalogue_.stars.size());
    catalogue_.stars.push_back(star);
    if (star.id != kNoStarId) {
      by_id_.emplace(star.id, place);
    } else if (!folded_star_name(cell).empty()) {
      catalogue_.names.push_back({place, std::string(cell)});
      by_name_.emplace(folded_star_name(cell), place);
    }
  }

  RawCatalogue& catalogue_;
  CsvFile row_;
  std::unordered_map<StarId, std::uint32_t> by_id_;
  std::unordered_map<std::string, std::uint32_t> by_name_;
  std::unordered_set<std::string> ambiguous_;  // names of several stars
  std::unordered_set<std::ptrdiff_t> seen_;    // indices of stars that a row has named
};

using StarIndices = std::vector<std::uint32_t>;

class Repair {
 public:
  // Finds the stars of each Hipparcos number, which components of one star share.
  Repair(RawCatalogue& catalogue, HipparcosRepair& done) : stars_(catalogue.stars), done_(done) {
    for (std::uint32_t i = 0; i < stars_.size(); ++i)
      if (stars_[i].hip != 0) with_number_[stars_[i].hip].push_back(i);
  }

  // Lays one star of Hipparcos over those that bear its number, or adds it.
  void lay_over(const CatalogueStar& hipparcos) {
    const auto found = with_number_.find(hipparcos.hip);
    if (found == with_number_.end()) {
      stars_.push_back(hipparcos);
      ++done_.added;
    } else {
      take_colour(found->second, hipparcos.colour);
      take_magnitude(found->second, hipparcos.v);
    }
  }

 private:
  // The colour of Hipparcos replaces that of a single star.  It says little about one star of
  // several, so there it only fills a gap.
  void take_colour(const StarIndices& places, float colour) {
    if (colour == kNoColour) return;
    for (const std::uint32_t i : places) {
      const bool had_none = stars_[i].colour == kNoColour;
      if (!had_none && places.size() > 1) continue;
      stars_[i].colour = colour;
      if (had_none) ++done_.colours;
    }
  }

  // Magnitudes do not add, but fluxes do: the sum of the stars has V = -2.5 log10(sum of 10^(-0.4
  // V)).
  void take_magnitude(const StarIndices& places, float v) {
    double flux = 0;
    for (const std::uint32_t i : places) {
      if (places.size() > 1 && !stars_[i].v_is_rough) return;
      flux += std::pow(10, -0.4 * stars_[i].v);
    }
    const double sum = -2.5 * std::log10(flux);
    for (const std::uint32_t i : places) {
      // A shift that is the same for all multiplies all fluxes by one factor, so that their ratios
      // stay.
      stars_[i].v = places.size() == 1 ? v : static_cast<float>(stars_[i].v + (v - sum));
      stars_[i].v_is_rough = false;
      ++done_.stars;
    }
  }

  std::vector<CatalogueStar>& stars_;
  HipparcosRepair& done_;
  std::unordered_map<std::uint32_t, StarIndices> with_number_;
};

}  // namespace

std::size_t apply_corrections(RawCatalogue& catalogue, const std::filesystem::path& file) {
  return Corrections(catalogue, file).apply();
}

HipparcosRepair repair_by_hipparcos(RawCatalogue& catalogue, const RawCatalogue& hipparcos) {
  HipparcosRepair done;
  Repair repair(catalogue, done);
  for (const CatalogueStar& star : hipparcos.stars)
    if (star.hip != 0) repair.lay_over(star);
  return done;
}

}  // namespace domefall
