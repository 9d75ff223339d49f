#include "pipeline/render/disc/gas_pass.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/catmull_rom.h"
#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/vector_math.h"
#include "projections/pixel_directions.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Rays are this far apart (radians), or a third of what the gas changes over, or two pixels if that is
// more, but in a frame that is no draft no more than half as much again.
constexpr double kSpacing = 0.04, kClosest = 0.006, kOfFinest = 0.33, kPixels = 2;
// Rows for each factor e towards the edge, and the distance at which these end, in pixels.
constexpr double kPerLogOfDisc = 16, kPerLog = 10, kNearest = 1.0 / 16;
constexpr int kMostParts = 24;

// Adds the weighted mean of blocks of eight.
[[gnu::always_inline]] inline void add_blocks_loop(const float* const* from, const float* weights,
                                                   int count, float* sum) {
  float values[8];
  for (int n = 0; n < 8; ++n) values[n] = sum[n];
  for (int k = 0; k < count; ++k)
    for (int n = 0; n < 8; ++n) values[n] += weights[k] * from[k][n];
  for (int n = 0; n < 8; ++n) sum[n] = values[n];
}
Dispatched<add_blocks_loop> add_blocks;

// A GasGrid says where rays stand: alpha counts from R times `sign`, and the numbers a, b and e make x.
struct GasGrid {
  double sign, edge, a, b, e;
};

// Finds alpha, x and the azimuth about R of directions.
[[gnu::always_inline]] inline void find_polar_loop(const GasGrid& grid, const DirectionBatch& n,
                                                   int count, double* alpha, double* x,
                                                   double* azimuth) {
  const GasGrid g = grid;
  for (int k = 0; k < count; ++k) {
    const double y = n.y[k], z = n.z[k];
    alpha[k] = arc_tangent2(__builtin_sqrt(y * y + z * z), g.sign * n.x[k]);
    const double off = alpha[k] - g.edge, d = off < 0 ? -off : off;
    x[k] = g.a * logarithm(1 + d / g.e) + g.b * d;
    azimuth[k] = arc_tangent2(z, y);
  }
}
Dispatched<find_polar_loop> find_polar;

// Says whether a cubic serves for the light of a pixel, times a weight.  Beside what is brighter by far
// it falls below the rays around it, or has its place by cancellation.
bool suits_cubic(const std::array<float, 8>& block, const std::array<const float*, 16>& rays,
                 float weight) {
  constexpr float kBrighter = 20;
  for (std::size_t c = 0; c < 3; ++c) {
    if (block[c] < weight * std::min({rays[5][c], rays[6][c], rays[9][c], rays[10][c]}))
      return false;
    for (const float* ray : rays)
      if (weight * ray[c] > kBrighter * block[c]) return false;
  }
  return true;
}

}  // namespace

GasPass::GasPass(const FrameScene& scene, const std::atomic<bool>* stop)
    : rays_(scene),
      exposure_(scene.exposure),
      view_(rays_.view()),
      bent_(view_.edge || view_.edge_at),
      log_rows_(!bent_             ? 0
                : rays_.has_disc() ? kPerLogOfDisc
                                   : kPerLog),
      least_(kNearest * largest_pixel_angle(scene.projection())) {
  const double least = std::clamp(kOfFinest * rays_.finest(), kClosest, kSpacing),
               pixels = kPixels * largest_pixel_angle(scene.projection());
  const double spacing = std::clamp(pixels, least, scene.plan.pixel > 0 ? HUGE_VAL : 1.5 * least);
  even_rows_ = 1 / spacing;
  columns_ = std::clamp(static_cast<int>(2 * pi / spacing), 64, 4096);
  blocks_ = rays_.has_pattern() ? kMostBlocks : 1;
  if (rays_.has_pattern()) pattern_ = scene.disc->pattern();
  // An edge that is one for each azimuth is farthest somewhere.
  double least_edge = pi, greatest_edge = 0;
  for (int column = 0; column < columns_; ++column) {
    const double edge = view_.edge_of(2 * pi * column / columns_);
    least_edge = std::min(least_edge, edge), greatest_edge = std::max(greatest_edge, edge);
  }
  if (greatest_edge > 0) add_side(-1, greatest_edge);
  add_side(1, pi - least_edge);
  std::size_t rows = 0;
  for (Side& side : sides_) side.first_row = rows, rows += static_cast<std::size_t>(side.rows);
  const std::size_t rays = rows * static_cast<std::size_t>(columns_);
  grid_.resize(rays * blocks_);
  lit_.assign(rays, 0);
  for (const Side& side : sides_) {
    tbb::parallel_for(0, side.rows, [&](int row) {
      if (!stop || !*stop) follow_row(side, row);
    });
    if (stop && *stop) return;
    if (rays_.has_pattern()) find_widths(side);
  }
  mark_lit();
}

void GasPass::add_side(double sign, double reach) {
  // The axis itself has no plane.
  constexpr double kOffAxis = 1e-6;
  Side side{sign, reach - kOffAxis};
  side.rows = static_cast<int>(std::ceil(x_of(side.reach))) + 1;
  side.last = x_of(side.reach);
  sides_.push_back(side);
}

double GasPass::x_of(double d) const {
  return log_rows_ * logarithm(1 + d / least_) + even_rows_ * d;
}

// By bisection, since a row is found once.
double GasPass::d_of(double x) const {
  double low = 0, high = pi;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (x_of(middle) < x ? low : high) = middle;
  }
  return low;
}

void GasPass::follow_row(const Side& side, int row) {
  const double d = std::max(d_of(side.last * row / (side.rows - 1)), least_ / 2);
  LightPath path;
  for (int column = 0; column < columns_; ++column) {
    const double azimuth = 2 * pi * column / columns_;
    double alpha = view_.edge_of(azimuth) + side.sign * d;
    const SineCosine turned = sin_cos(azimuth);
    V3d across(0, turned.cosine, turned.sine);
    // Beyond R and -R the direction is one of the other side.
    if (alpha < 0 || alpha > pi) alpha = alpha < 0 ? -alpha : 2 * pi - alpha, across = -across;
    if (column == 0 || !rays_.paths_are_alike()) path = rays_.path(alpha, across);
    GasSight sight;
    if (!path.places.empty())
      sight = rays_.sight(path, across,
                          rays_.scene().tracer.frequency_from(rays_.direction_of(alpha, across)));
    const std::size_t ray = ray_at(side, row, column);
    Block* out = blocks_of(ray);
    const auto& c = sight.light;
    out[0] = {c[0], c[1], c[2], sight.left, 0, 0, 0, 0};
    lit_[ray] = c[0] + c[1] + c[2] > 0 || sight.left < 1;
    for (std::size_t n = 1; n < blocks_; ++n) {
      const GasLook& look = sight.looks[n - 1];
      const auto& l = look.light;
      out[n] = {l[0], l[1], l[2], look.x, look.y, look.time, 0, 0};
      if (l[0] + l[1] + l[2] > 0) lit_[ray] |= static_cast<unsigned char>(1u << n);
    }
  }
}

// Finds by how much the places of looks differ from ray to ray.
void GasPass::find_widths(const Side& side) {
  struct Place {
    double share, x, y, time;
  };
  const auto place = [&](int row, int column, std::size_t look) {
    const Block& v = blocks_of(ray_at(side, row, (column + columns_) % columns_))[look];
    const double share = double{v[0]} + v[1] + v[2];
    return Place{share, v[3] / share, v[4] / share, v[5] / share};
  };
  const GasOrbits& orbits = rays_.scene().disc->disc().orbits;
  const auto d_at = [&](int row) { return d_of(side.last * row / (side.rows - 1)); };
  tbb::parallel_for(0, side.rows, [&](int row) {
    // Next to the axis rays are so close that their differences would be those of rounding.
    const int above = std::max(row - 1, 0), below = std::min(row + 1, side.rows - 1);
    const double d = d_at(row), high = d_at(below) - d_at(above);
    for (int column = 0; column < columns_; ++column) {
      const double sine =
          std::abs(sin_cos(view_.edge_of(2 * pi * column / columns_) + side.sign * d).sine);
      const double wide = std::max(sine, 0.5 / even_rows_) * 4 * pi / columns_;
      for (std::size_t look = 1; look < blocks_; ++look) {
        const Place here = place(row, column, look);
        if (!(here.share > 0)) continue;
        const double r = std::sqrt(here.x * here.x + here.y * here.y),
                     turning = orbits.angular_velocity(r);
        double along = 0, about = 0;  // squares of what r and the azimuth change by in a radian
        const auto add = [&](const Place& a, const Place& b, double angle) {
          if (!(a.share > 0 && b.share > 0)) return;
          const double dx = (b.x - a.x) / angle, dy = (b.y - a.y) / angle;
          const double outward = (dx * here.x + dy * here.y) / r,
                       around = (dy * here.x - dx * here.y) / (r * r) -
                                turning * (b.time - a.time) / angle;
          along += outward * outward, about += around * around;
        };
        add(place(above, column, look), place(below, column, look), high);
        add(place(row, column - 1, look), place(row, column + 1, look), wide);
        Block& v = blocks_of(ray_at(side, row, column))[look];
        v[6] = static_cast<float>(here.share * std::sqrt(along));
        v[7] = static_cast<float>(here.share * std::sqrt(about));
      }
    }
  });
}

// A pixel needs four rays by four, of which it lies between the middle ones.
void GasPass::mark_lit() {
  const std::vector<unsigned char> own = lit_;
  for (const Side& side : sides_)
    for (int row = 0; row < side.rows; ++row)
      for (int column = 0; column < columns_; ++column) {
        unsigned char& lit = lit_[ray_at(side, row, column)];
        for (int down = std::max(row - 1, 0); down <= std::min(row + 2, side.rows - 1); ++down)
          for (int on = -1; on <= 2; ++on)
            lit |= own[ray_at(side, down, (column + on + columns_) % columns_)];
      }
}

unsigned GasPass::add_values(const Side& side, double x, double azimuth, float weight,
                             Values& values) const {
  const double row = std::clamp(x / side.last, 0.0, 1.0) * (side.rows - 1);
  const double turns = azimuth / (2 * pi), column = (turns - std::floor(turns)) * columns_;
  const int i = std::min(static_cast<int>(row), side.rows - 2),
            j = std::min(static_cast<int>(column), columns_ - 1);
  const unsigned lit = lit_[ray_at(side, i, j)];
  if (!lit) {
    values[0][3] += weight;
    return 0;
  }
  const std::array<float, 4> down = catmull_rom(static_cast<float>(row - i)),
                             on = catmull_rom(static_cast<float>(column - j));
  std::array<float, 16> weights;
  std::array<const Block*, 16> rays;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t m = 0; m < 4; ++m) {
      const int r = std::clamp(i + static_cast<int>(k) - 1, 0, side.rows - 1),
                c = (j + static_cast<int>(m) - 1 + columns_) % columns_;
      weights[4 * k + m] = weight * down[k] * on[m];
      rays[4 * k + m] = grid_.data() + ray_at(side, r, c) * blocks_;
    }
  for (std::size_t n = 0; n < blocks_; ++n) {
    // What is left is there always.
    if (n > 0 && !(lit & 1u << n)) continue;
    std::array<const float*, 16> from;
    for (std::size_t k = 0; k < from.size(); ++k) from[k] = rays[k][n].data();
    Block block{};
    add_blocks(from.data(), weights.data(), 16, block.data());
    if (!suits_cubic(block, from, weight)) {
      block.fill(0);
      const std::array<const float*, 4> middle{from[5], from[6], from[9], from[10]};
      const auto on_part = static_cast<float>(column - j), down_part = static_cast<float>(row - i);
      const std::array<float, 4> linear{
          weight * (1 - down_part) * (1 - on_part), weight * (1 - down_part) * on_part,
          weight * down_part * (1 - on_part), weight * down_part * on_part};
      add_blocks(middle.data(), linear.data(), 4, block.data());
    }
    for (std::size_t c = 0; c < kBlock; ++c) values[n][c] += block[c];
  }
  return lit;
}

// Next to the edge rows are closer than pixels, which then are the mean of several places.
unsigned GasPass::find_values(double alpha, double x, double azimuth, double width,
                              Values& values) const {
  const double edge = view_.edge_of(azimuth);
  for (std::size_t n = 0; n < blocks_; ++n) values[n].fill(0);
  const auto side_of = [this, edge](double there) -> const Side& {
    return there < edge ? sides_.front() : sides_.back();
  };
  const double off = std::max(std::abs(alpha - edge) - width / 2, least_);
  const double rows = width * (log_rows_ / off + even_rows_);
  if (rows <= 1) return add_values(side_of(alpha), x, azimuth, 1, values);
  // The weights are a tent of a pixel and a half, about what a pixel's square has of a thin ring at any
  // angle.
  constexpr double kReach = 0.75;
  const int parts = std::min(static_cast<int>(std::ceil(2 * kReach * rows)), kMostParts);
  double sum = 0;
  const auto place = [&](int k) { return kReach * (2 * k + 1 - parts) / parts; };
  for (int k = 0; k < parts; ++k) sum += kReach - std::abs(place(k));
  unsigned lit = 0;
  for (int k = 0; k < parts; ++k) {
    const double there = alpha + width * place(k);
    lit |= add_values(side_of(there), x_of(std::abs(there - edge)), azimuth,
                      static_cast<float>((kReach - std::abs(place(k))) / sum), values);
  }
  return lit;
}

void GasPass::draw_rows(int first, int end, float* rgb, float* left) const {
  const Projection& projection = rays_.scene().projection();
  const std::ptrdiff_t width = domefall::columns(projection);
  for (int row = first; row < end; ++row) {
    const ColumnRange inside = inside_columns(projection, row);
    const std::ptrdiff_t begin = (row - first) * width;
    for (int column = inside.first; column <= inside.last; column += DirectionBatch::kSize)
      draw_pixels(row, column, std::min(DirectionBatch::kSize, inside.last + 1 - column),
                  rgb + 3 * begin, left ? left + begin : nullptr);
  }
}

void GasPass::draw_pixels(int row, int column, int count, float* rgb, float* left) const {
  DirectionBatch::Column<double> i{}, j{}, angle{};
  std::array<CameraDirection, DirectionBatch::kSize> n{};
  for (int k = 0; k < count; ++k) i[k] = column + k + 1, j[k] = row + 1;
  find_directions(rays_.scene().projection(), i.data(), j.data(), count, n.data(), angle.data());
  FrameRayBatch frame;
  rays_.scene().tracer.into_frame(n.data(), count, frame);
  struct Patterned {
    std::array<float, 3> light;
    int pixel;
  };
  std::array<Patterned, DirectionBatch::kSize * GasSight::kLooks> patterned;
  std::array<PatternPlace, patterned.size()> places;
  std::array<float, patterned.size()> factors;
  std::size_t looks = 0;
  const auto exposure = static_cast<float>(exposure_);
  const double now = pattern_ ? rays_.observer_time() : 0,
               inner = pattern_ ? rays_.scene().disc->disc().inner : 0;
  DirectionBatch::Column<double> alpha, x_coordinate, azimuth;
  const GasGrid grid{rays_.counts_from_hole() ? -1.0 : 1.0, view_.edge.value_or(0), log_rows_,
                     even_rows_, least_};
  find_polar(grid, frame, count, alpha.data(), x_coordinate.data(), azimuth.data());
  if (view_.edge_at)
    for (int k = 0; k < count; ++k)
      x_coordinate[k] = x_of(std::abs(alpha[k] - view_.edge_of(azimuth[k])));
  for (int k = 0; k < count; ++k) {
    const double width = angle[k] * frame.scale[k];
    Values values;
    const unsigned lit = find_values(alpha[k], x_coordinate[k], azimuth[k], width, values);
    if (!lit) continue;
    float* const pixel = rgb + 3 * static_cast<std::ptrdiff_t>(column + k);
    const float kept = std::clamp(values[0][3], 0.0f, 1.0f);
    for (std::size_t c = 0; c < 3; ++c)
      pixel[c] = kept * pixel[c] + exposure * std::max(values[0][c], 0.0f);
    if (left) left[column + k] = kept;
    for (std::size_t look_at = 1; look_at < blocks_; ++look_at) {
      if (!(lit & 1u << look_at)) continue;
      const Block& v = values[look_at];
      const float share = v[0] + v[1] + v[2];
      if (!(share > 0)) continue;
      Patterned& look = patterned[looks];
      for (std::size_t c = 0; c < 3; ++c) look.light[c] = exposure * std::max(v[c], 0.0f);
      look.pixel = column + k;
      const double x = v[3] / share, y = v[4] / share;
      places[looks++] = {std::max(std::sqrt(x * x + y * y), inner), arc_tangent2(y, x),
                         now + v[5] / share, width * std::max(0.0f, v[6] / share),
                         width * std::max(0.0f, v[7] / share)};
    }
  }
  if (looks == 0) return;
  pattern_->factors({places.data(), looks}, {factors.data(), looks});
  for (std::size_t k = 0; k < looks; ++k)
    for (std::size_t c = 0; c < 3; ++c)
      rgb[3 * static_cast<std::ptrdiff_t>(patterned[k].pixel) + static_cast<std::ptrdiff_t>(c)] +=
          factors[k] * patterned[k].light[c];
}

}  // namespace domefall
