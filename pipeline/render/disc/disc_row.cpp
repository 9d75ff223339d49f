#include "pipeline/render/disc/disc_row.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/render/disc/rim_coverage.h"
#include "pipeline/spacetime/schwarzschild.h"
#include "projections/pixel_directions.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Nodes are used where the quantities that decide where a ray meets the disc change by less than
// this part of themselves from node to node.
constexpr double kSteady = 0.25;
// Therefore a distance to a rim may change this much faster between two nodes than at either node.
constexpr double kFaster = 1.6;
// A cubic is trusted if the third and fourth differences of its nodes are smaller than these parts
// of the light.  Next to a rim, where differences grow from node to node, the limits are a quarter
// of these.  The error of a cubic through even nodes is f''''/24 times the product of the distances
// to the four nodes.  That product is at most 1 in steps, so the error is at most 1/24 of the
// fourth difference.
constexpr double kMostThird = 0.02, kMostFourth = 0.006, kNextToRim = 0.25;
// Places are judged by so many pixels, which makes them right to a fortieth of one.
constexpr double kPixels = 100;

// The numbers of a look behind its light's r, g and b.
enum LookNumber : std::size_t { kRadius = 3, kAzimuth, kTime, kRadiusWidth, kAzimuthWidth };

// The CellWeights of a cell are Lagrange's weights of four nodes for each of its eight pixels.  The
// cell `first_cell` lies between the nodes first_cell and first_cell + 1 of the four.
using CellWeights = std::array<std::array<double, 4>, 8>;
CellWeights cell_weights(double first_cell) {
  CellWeights weights;
  for (std::size_t x = 0; x < weights.size(); ++x) {
    const double t = first_cell + static_cast<double>(x) / static_cast<double>(weights.size());
    const double a = t, b = t - 1, c = t - 2, d = t - 3;
    weights[x] = {-b * c * d / 6, a * c * d / 2, -a * b * d / 2, a * b * c / 6};
  }
  return weights;
}

// Returns a bound on the Lorentz factor of the camera against the frame in which the paths of light
// are known.  For two boosts in a row gamma = gamma_1 gamma_2 (1 + v_1.v_2), which is at most
// 2 gamma_1 gamma_2.
double most_gamma(const FrameScene& scene) {
  const Viewer& viewer = scene.tracer.viewer();
  const double gamma = gamma_of(viewer.celerity);
  if (!scene.tracer.goes_straight()) return gamma;
  return 2 * gamma * std::sqrt(1 + viewer.rest.dot(viewer.rest));
}

}  // namespace

bool DiscPass::Row::is_steady(const FrameScene& scene) {
  // The Doppler factor is gamma (1 + v cos a).  Its relative change with the angle a is at most
  // gamma v for each radian.
  return kStep * largest_pixel_angle(scene.projection()) * most_gamma(scene) < kSteady;
}

DiscPass::Row::Row(const DiscPass& pass, bool with_nodes)
    : pass_(pass),
      exposure_(static_cast<float>(pass.scene_.exposure * pass.scene_.state.settings.disc_gain)),
      with_nodes_(with_nodes),
      strip_(pass.make_strip()) {
  const auto width = static_cast<std::size_t>(columns(pass.scene_.projection()));
  nodes_.reserve(width / kStep + 1);
  single_.reserve(width);
}

void DiscPass::Row::draw(int row, float* rgb, float* left) {
  const ColumnRange inside = inside_columns(pass_.scene_.projection(), row);
  const int width = inside.last - inside.first + 1;
  if (width <= 0) return;
  first_ = inside.first;
  left_ = left;
  single_.clear();
  lights_.clear(), places_.clear(), columns_.clear();
  const int cells = with_nodes_ ? (width - 1) / kStep : 0;
  nodes_.resize(static_cast<std::size_t>(cells) + 1);
  for (int at = 0; cells > 0 && at <= cells; at += Strip::kSize)
    find_nodes(row, at, std::min(Strip::kSize, cells + 1 - at));
  for (std::size_t at = 0; at < static_cast<std::size_t>(cells);) {
    // A run goes on as long as neighbouring nodes are joined.  The cell behind its last node is
    // drawn pixel by pixel.
    std::size_t last = at;
    while (last < static_cast<std::size_t>(cells) && joined(nodes_[last], nodes_[last + 1])) ++last;
    draw_run(at, last, rgb);
    at = last;
    if (at == static_cast<std::size_t>(cells)) break;
    for (int x = 0; x < kStep; ++x) single_.push_back(first_ + static_cast<int>(at) * kStep + x);
    ++at;
  }
  for (int column = first_ + cells * kStep; column <= inside.last; ++column)
    single_.push_back(column);
  draw_patterns(rgb);
  draw_singly(row, rgb);
}

void DiscPass::Row::fill_orders(int row, std::span<float* const> orders) {
  const ColumnRange inside = inside_columns(pass_.scene_.projection(), row);
  for (int at = inside.first; at <= inside.last; at += Strip::kSize) {
    const int count = std::min(Strip::kSize, inside.last + 1 - at);
    locate(row, count, [at](int k) { return at + k; });
    strip_->gather();
    for (std::size_t order = 0; order < orders.size(); ++order)
      for (int k = 0; k < count; ++k)
        orders[order][at + k] = static_cast<float>(strip_->taken(k, order));
  }
}

// Finds where `count` pixels of a row see the disc.
template <class ColumnOf>
void DiscPass::Row::locate(int row, int count, const ColumnOf& column_of) {
  std::array<double, Strip::kSize> i{}, j{}, angle{};
  std::array<CameraDirection, Strip::kSize> n{};
  for (int k = 0; k < count; ++k) {
    i[static_cast<std::size_t>(k)] = column_of(k) + 1;
    j[static_cast<std::size_t>(k)] = row + 1;
  }
  find_directions(pass_.scene_.projection(), i.data(), j.data(), count, n.data(), angle.data());
  strip_->locate(n.data(), angle.data(), count);
}

void DiscPass::Row::find_nodes(int row, int first, int count) {
  locate(row, count, [&](int k) { return first_ + (first + k) * kStep; });
  std::array<bool, Strip::kSize> lit{};
  for (int k = 0; k < count; ++k) {
    Node& node = nodes_[static_cast<std::size_t>(first + k)] = {};
    node.seen = strip_->sighting(k);
    lit[static_cast<std::size_t>(k)] = node.seen.lit;
  }
  strip_->look(lit.data());
  for (int k = 0; k < count; ++k) {
    Node& node = nodes_[static_cast<std::size_t>(first + k)];
    note_looks(node, first + k > 0 ? nodes_[static_cast<std::size_t>(first + k - 1)] : node, k);
    node.left = strip_->left(k);
  }
}

// Azimuths go on from those of the node before.
void DiscPass::Row::note_looks(Node& node, const Node& before, int k) {
  const Strip::Looks& seen = strip_->looks(k);
  for (std::size_t n = 0; n < seen.at.size() && static_cast<int>(n) < seen.count; ++n) {
    const auto& [light, at] = seen.at[n];
    const double turned =
        static_cast<int>(n) < before.count
            ? 2 * pi * std::round((before.looks[n][kAzimuth] - at.azimuth) / (2 * pi))
            : 0;
    node.looks[n] = {exposure_ * light.r, exposure_ * light.g,
                     exposure_ * light.b, at.r,
                     at.azimuth + turned, at.time,
                     at.r_width,          at.azimuth_width};
  }
  node.count = seen.count;
}

// Says whether no rim touches a pixel at two neighbouring nodes or between them.
bool DiscPass::Row::joined(const Node& a, const Node& b) const {
  return a.seen.sight == b.seen.sight && a.seen.clearance > kRimReach &&
         b.seen.clearance > kRimReach &&
         a.seen.clearance + b.seen.clearance > kFaster * (kStep + 2 * kRimReach);
}

// Draws the cells between nodes that see the same images.  Pixels of cells that no cubic can draw
// are noted in single_.
void DiscPass::Row::draw_run(std::size_t first, std::size_t last, float* rgb) {
  if (!nodes_[first].seen.lit) return;
  for (std::size_t at = first; at < last; ++at) {
    const int column = first_ + static_cast<int>(at) * kStep;
    if (last - first + 1 >= kJudges) {
      // The judges are the five nodes of the run around the cell.
      const std::size_t judge = std::clamp(at, first + 2, last - 2) - 2,
                        from = std::clamp(at, first + 1, last - 2) - 1;
      const Cell cell{&nodes_[judge], from - judge, at - from, column,
                      at == first || at + 1 == last};
      if (trusted(cell)) {
        draw_cell(cell, rgb);
        continue;
      }
    }
    for (int x = 0; x < kStep; ++x) single_.push_back(column + x);
  }
}

// Says whether cubics are accurate in a cell.
bool DiscPass::Row::trusted(const Cell& cell) const {
  const Node* const judges = cell.judges;
  const double trust = cell.next_to_rim ? kNextToRim : 1;
  const auto smooth = [trust](const auto& value, double size) {
    const auto third = [&](std::size_t k) {
      return value(k + 3) - value(k) + 3 * (value(k + 1) - value(k + 2));
    };
    const double before = third(0), after = third(1), most = trust * size;
    return std::abs(before) <= kMostThird * most && std::abs(after) <= kMostThird * most &&
           std::abs(after - before) <= kMostFourth * most;
  };
  const Node& middle = judges[2];
  const auto count = static_cast<std::size_t>(middle.count);
  if (count > middle.looks.size()) return false;
  for (std::size_t k = 0; k < kJudges; ++k)
    if (judges[k].count != middle.count) return false;
  if (!smooth([&](std::size_t k) { return judges[k].left; }, 1)) return false;
  std::array<double, 3> light{};
  for (std::size_t n = 0; n < count; ++n)
    for (std::size_t c = 0; c < 3; ++c) light[c] += middle.looks[n][c];
  for (std::size_t n = 0; n < count; ++n) {
    const auto& at = middle.looks[n];
    const double high = at[kRadiusWidth], wide = at[kAzimuthWidth],
                 turning = pass_.scene_.disc->disc().orbits.angular_velocity(at[kRadius]);
    const std::array<double, 8> sizes{
        light[0], light[1], light[2], kPixels * high, kPixels * wide, kPixels * wide / turning,
        high,     wide};
    for (std::size_t c = 0; c < (pass_.pattern_ ? sizes.size() : 3); ++c)
      if (!smooth([&](std::size_t k) { return judges[k].looks[n][c]; }, sizes[c])) return false;
  }
  return true;
}

// Draws a cell by cubics.  Light that a pattern multiplies is noted.
void DiscPass::Row::draw_cell(const Cell& cell, float* rgb) {
  static const std::array<CellWeights, 3> kWeights{cell_weights(0), cell_weights(1),
                                                   cell_weights(2)};
  const Node* const nodes = cell.judges + cell.from;
  for (int x = 0; x < kStep; ++x) {
    const std::array<double, 4>& w = kWeights[cell.within][static_cast<std::size_t>(x)];
    const int column = cell.column + x;
    double part = 0;
    for (std::size_t k = 0; k < w.size(); ++k) part += w[k] * nodes[k].left;
    const auto left = static_cast<float>(std::clamp(part, 0.0, 1.0));
    float* const pixel = rgb + 3 * static_cast<std::ptrdiff_t>(column);
    for (int c = 0; c < 3; ++c) pixel[c] *= left;
    if (left_) left_[column] = left;
    for (std::size_t n = 0; n < static_cast<std::size_t>(nodes[0].count); ++n) {
      std::array<double, 8> at{};
      for (std::size_t k = 0; k < w.size(); ++k)
        for (std::size_t c = 0; c < at.size(); ++c) at[c] += w[k] * nodes[k].looks[n][c];
      const std::array<float, 3> light{static_cast<float>(at[0]), static_cast<float>(at[1]),
                                       static_cast<float>(at[2])};
      if (!pass_.pattern_) {
        for (std::size_t c = 0; c < 3; ++c) pixel[c] += light[c];
        continue;
      }
      columns_.push_back(column), lights_.push_back(light);
      places_.push_back({at[kRadius], at[kAzimuth], at[kTime], std::max(0.0, at[kRadiusWidth]),
                         std::max(0.0, at[kAzimuthWidth])});
    }
  }
}

// Draws the light that a pattern multiplies.
void DiscPass::Row::draw_patterns(float* rgb) {
  if (places_.empty()) return;
  factors_.resize(places_.size());
  pass_.pattern_->factors(places_, factors_);
  for (std::size_t k = 0; k < places_.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c)
      rgb[3 * static_cast<std::size_t>(columns_[k]) + c] += factors_[k] * lights_[k][c];
}

void DiscPass::Row::draw_singly(int row, float* rgb) {
  for (std::size_t at = 0; at < single_.size(); at += Strip::kSize) {
    const int* column = &single_[at];
    const int count = static_cast<int>(std::min<std::size_t>(single_.size() - at, Strip::kSize));
    locate(row, count, [column](int k) { return column[k]; });
    strip_->gather();
    for (int k = 0; k < count; ++k) {
      const auto left = static_cast<float>(strip_->left(k));
      if (left_) left_[column[k]] = left;
      const WorkingRgb& light = strip_->light(k);
      float* pixel = rgb + 3 * static_cast<std::ptrdiff_t>(column[k]);
      pixel[0] = left * pixel[0] + exposure_ * light.r;
      pixel[1] = left * pixel[1] + exposure_ * light.g;
      pixel[2] = left * pixel[2] + exposure_ * light.b;
    }
  }
}

}  // namespace domefall
