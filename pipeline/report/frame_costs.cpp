#include "pipeline/report/frame_costs.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <numbers>

#include "pipeline/base/errors.h"
#include "pipeline/base/temporary_file.h"
#include "pipeline/report/frame_timing.h"
#include "pipeline/report/made_up_stars.h"
#include "pipeline/show/file/read_show.h"
#include "pipeline/sources/stars/star_file.h"

namespace domefall {
namespace {

constexpr int kThreads = 1;

enum class Place { kBesideTheHole, kFlat };
enum class Background { kBlack, kMilkyWay };

struct Sizes {
  std::vector<double> stars;
  int dome;                // for the rows against stars
  std::vector<int> domes;  // for the rows against pixels
  double stars_of_domes;   // as many as Hipparcos has
  int benchmark;           // pixels along an edge of the benchmark's frame
  double benchmark_stars;
  Repeats repeats;
};

Sizes sizes(bool quick) {
  if (quick) return {{1e3, 3e3, 1e4}, 256, {128, 256, 512}, 1e3, 128, 1e3, {3, 1}};
  // A catalogue has about three times the stars of the one before, the last one nearly all of
  // kMostMadeUpStars, and a dome has twice the width.  The benchmark has the paper's million pixels
  // and 250,000 stars ([Riazuelo] sec. sec_data).
  return {{1e4, 3e4, 1e5, 3e5, 1e6, 2.5e6},
          4096,
          {1024, 2048, 4096, 8192},
          118218,
          1000,
          250e3,
          {9, 4}};
}

// The class Shows makes shows with the brightest stars of one catalogue, and keeps their files in a
// folder of its own.
class Shows {
 public:
  explicit Shows(std::size_t most_stars) {
    write_star_file(folder_ / kCatalogue, made_up_stars(most_stars));
  }

  Show show(Place place, Background background, double stars, const Projection& projection) const {
    const bool flat = place == Place::kFlat;
    // The limiting magnitude lies between the star of this rank and the next one.
    const std::string limit = fmt::format("{{catalogue: {}, max_magnitude: {:.9g}}}", kCatalogue,
                                          magnitude_of_rank(stars + 0.5));
    Show read = read_show(written(fmt::format(
        "{}camera: {{look_at: {}{}}}\n"
        "sky: {{region_I: {{background: {}, stars: {}}}}}\n"
        "timeline:\n  - {{duration_s: 1{}}}\n",
        flat ? "" : "black_hole: {mass_solar: 4.3e6}\n",
        flat ? "{ra_deg: 266.417, dec_deg: -29.008}" : "hole",
        has_zenith(projection) ? ", elevation_deg: 45" : "",
        background == Background::kBlack ? "black" : "milky_way", stars > 0 ? limit : "none",
        flat ? "" : ", trajectory: {type: infall, from_r: 7}")));
    read.projection = projection;
    return read;
  }

  // Returns the number of stars that such a show has.  It may differ from `stars`: where two stars
  // have the same magnitude as floats, a show has both of them or neither.
  double count(double stars) const {
    if (stars <= 0) return 0;
    return static_cast<double>(
        StarFile(folder_ / kCatalogue).up_to(magnitude_of_rank(stars + 0.5)).size());
  }

 private:
  static constexpr const char* kCatalogue = "made_up.stars";

  std::filesystem::path written(const std::string& text) const {
    std::filesystem::path file = folder_ / "cost.yaml";
    std::ofstream out(file);
    out << text;
    out.close();
    if (!out) throw TemporaryError(file.string() + ": cannot be written");
    return file;
  }

  ScratchFolder folder_;
};

double pixels_inside(const Projection& projection) {
  double count = 0;
  for (int row = 0; row < rows(projection); ++row) {
    const ColumnRange inside = inside_columns(projection, row);
    count += std::max(0, inside.last - inside.first + 1);
  }
  return count;
}

// Returns the state of the same frame without its stars.  It belongs to the same show, so a
// renderer reads the files once for both frames.
FrameState starless(FrameState state) {
  state.settings.sky[SkyRegion::kI].star_gain = 0;
  return state;
}

// Returns the cost of a frame.  A copy of its memory is the unit of `copies`, since no renderer can
// do less than write each pixel once.
FrameCostRow measured_cost(const std::string& scene, Renderer& renderer, const FrameState& state,
                           double stars, Repeats repeats) {
  const TimedFrame timed = time_frame(renderer, state, repeats);
  return {scene,
          columns(state.projection),
          pixels_inside(state.projection),
          stars,
          timed.seconds,
          timed.seconds / copy_seconds(timed.frame)};
}

// Returns the rows against stars.  The limit of magnitude belongs to a show, so each number of
// stars has a show and a renderer of its own.
std::vector<FrameCostRow> against_stars(const Shows& shows, const Sizes& sizes) {
  std::vector<FrameCostRow> rows;
  for (const Place place : {Place::kBesideTheHole, Place::kFlat})
    for (const double stars : sizes.stars) {
      const Show show = shows.show(place, Background::kBlack, stars, Domemaster{sizes.dome});
      Renderer renderer(show, kThreads);
      rows.push_back(measured_cost(
          place == Place::kFlat ? "stars alone, flat space" : "stars alone, falling at 7 M",
          renderer, frame_state(show, 0), shows.count(stars), sizes.repeats));
    }
  return rows;
}

// Returns the rows against pixels.  One renderer makes them all from states that differ in the
// projection and the stars alone, so it reads the files once.
std::vector<FrameCostRow> against_pixels(const Shows& shows, const Sizes& sizes) {
  const double stars = shows.count(sizes.stars_of_domes);
  const Show show = shows.show(Place::kBesideTheHole, Background::kMilkyWay, sizes.stars_of_domes,
                               Domemaster{sizes.domes[0]});
  Renderer renderer(show, kThreads);
  std::vector<FrameCostRow> rows;
  for (const bool with_stars : {false, true})
    for (const int dome : sizes.domes) {
      FrameState state = frame_state(show, 0);
      state.projection = Domemaster{dome};
      if (with_stars)
        rows.push_back(measured_cost(fmt::format("Milky Way and {:.0f} stars", stars), renderer,
                                     state, stars, sizes.repeats));
      else
        rows.push_back(
            measured_cost("Milky Way alone", renderer, starless(state), 0, sizes.repeats));
    }
  return rows;
}

// Returns the rows of the benchmark.  "2 x 2 everywhere" is what the paper does, to compute a
// picture of twice the resolution and smooth it.
std::vector<FrameErrorRow> paper_benchmark(const Shows& shows, const Sizes& sizes) {
  constexpr double kFov = 100 * std::numbers::pi / 180;
  constexpr std::array<std::pair<const char*, AntiAliasing>, 3> kSettings{
      {{"4 x 4 in difficult pixels (default)", {}},
       {"2 x 2 everywhere", {2, true}},
       {"4 x 4 everywhere", {4, true}}}};
  const Projection flat = Stereographic{sizes.benchmark, sizes.benchmark, kFov};
  const Show show =
      shows.show(Place::kBesideTheHole, Background::kMilkyWay, sizes.benchmark_stars, flat);
  // The whole frame is timed.  Errors are measured without stars: they are drawn as the same blobs
  // with every setting.
  const FrameState whole = frame_state(show, 0), sky = starless(whole);
  const Grader grader(show.grade);
  const std::string scene = fmt::format("flat picture at 7 M, Milky Way, {:.0f} stars",
                                        shows.count(sizes.benchmark_stars));
  const GradedFrame truth = grader.grade(Renderer(show, 0, kReferenceAntiAliasing).render(sky));
  std::vector<FrameErrorRow> rows;
  for (const auto& [name, setting] : kSettings) {
    Renderer renderer(show, kThreads, setting);
    const TimedFrame timed = time_frame(renderer, whole, sizes.repeats);
    const FrameDifference error = difference(grader.grade(renderer.render(sky)), truth, flat);
    rows.push_back({scene, name, sizes.benchmark, error.rms, error.worst, timed.seconds,
                    timed.seconds / copy_seconds(timed.frame)});
  }
  return rows;
}

}  // namespace

FrameCosts measure_frame_costs(bool quick) {
  const Sizes all = sizes(quick);
  // One catalogue serves all frames, each of which takes the brightest of its stars.
  const double most = std::max({all.stars.back(), all.stars_of_domes, all.benchmark_stars});
  const Shows shows(static_cast<std::size_t>(most));
  return {against_stars(shows, all), against_pixels(shows, all), paper_benchmark(shows, all)};
}

std::vector<CostSlope> slopes(const std::vector<FrameCostRow>& rows,
                              double FrameCostRow::*counted) {
  constexpr double kNano = 1e9;
  std::vector<CostSlope> found;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const FrameCostRow &a = rows[k - 1], &b = rows[k];
    if (a.scene == b.scene)
      found.push_back({a.scene, a.*counted, b.*counted,
                       kNano * (b.seconds - a.seconds) / (b.*counted - a.*counted)});
  }
  return found;
}

std::optional<SteepestRise> steepest_rise(const std::vector<CostSlope>& of) {
  std::optional<SteepestRise> steepest;
  for (const CostSlope& slope : of)
    if (!(slope.ns > 0)) return std::nullopt;
  for (std::size_t k = 1; k < of.size(); ++k) {
    const double ratio = of[k].ns / of[k - 1].ns;
    if (of[k].scene == of[k - 1].scene && (!steepest || ratio > steepest->ratio))
      steepest = {of[k].scene, of[k].from, ratio};
  }
  return steepest;
}

// The first and the last row are taken as a series of their own, whose only slope is the mean.
double mean_slope(const std::vector<FrameCostRow>& rows, double FrameCostRow::*counted,
                  const std::string& scene) {
  std::vector<FrameCostRow> ends;
  for (const FrameCostRow& row : rows) {
    if (row.scene != scene) continue;
    if (ends.size() < 2)
      ends.push_back(row);
    else
      ends.back() = row;
  }
  return ends.size() < 2 ? 0 : slopes(ends, counted).front().ns;
}

}  // namespace domefall
