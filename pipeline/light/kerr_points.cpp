#include "pipeline/light/kerr_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/light/kerr_view.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Bins of the sky, evenly in z and in the azimuth.
constexpr int kRings = 64, kSectors = 128;
// A cell whose images are fainter than this part of their stars is left out.
constexpr double kFaintest = 3e-6;
// So are those whose places are not known to so many radians: the crowded images next to the corners of
// a hole that spins nearly as fast as it can.
constexpr double kLost = 1e-2;
// Cells are halved, from kLargest down to kSmallest (less in a chart of wide cells), where a caustic goes
// through them, or where they are not even to this part of their size.
constexpr double kUneven = 0.4, kLargest = 2, kSmallest = 0.125;
// Where the parabolas of a cell have an image so far from its middle, in halves of it, the chart may have
// one in it.
constexpr double kNearby = 1.5;
// So it may where they come this near to a place, as a part of the cell's size, and have no image.
constexpr double kByCaustic = 0.05;
// The smallest cells are this long at most (radians), so that those where light winds up faster are left
// out, too.
constexpr double kWound = 0.5 / kSmallest;

int ring_of(double z) { return std::clamp(static_cast<int>((z + 1) / 2 * kRings), 0, kRings - 1); }
int sector_of(double azimuth) {
  const double turns = azimuth / (2 * pi);
  return std::clamp(static_cast<int>((turns - std::floor(turns)) * kSectors), 0, kSectors - 1);
}

}  // namespace

struct KerrPoints::Sample {
  KerrChart::Value at;
  double view;  // the solid angle of one cell of the chart there
  double frequency_ratio;
};

// Three by three places of a rectangle of the chart.
struct KerrPoints::Net {
  double row, column, half_rows, half_columns;
  std::array<std::array<Sample, 3>, 3> samples;  // by row and by column

  const V3d& sky(int i, int j) const {
    return samples[static_cast<std::size_t>(i + 1)][static_cast<std::size_t>(j + 1)].at.sky;
  }
  // By how much it is bent from row to row, or from column to column, as a chord.
  double bend(bool by_rows) const {
    double most = 0;
    for (const int k : {-1, 0, 1}) {
      const auto on = [&](int step) { return by_rows ? sky(step, k) : sky(k, step); };
      most = std::max(most, (on(-1) + on(1) - on(0) * 2).length());
    }
    return most;
  }
};

KerrChart::Value KerrPoints::Cell::value(double at_row, double at_column) const {
  const auto u = static_cast<float>((at_row - row) / half_rows),
             v = static_cast<float>((at_column - column) / half_columns);
  const std::array<float, 3> by_u{u * (u - 1) / 2, 1 - u * u, u * (u + 1) / 2},
      by_v{v * (v - 1) / 2, 1 - v * v, v * (v + 1) / 2}, slope_u{u - 0.5F, -2 * u, u + 0.5F},
      slope_v{v - 0.5F, -2 * v, v + 0.5F};
  Imath::V3f sky(0, 0, 0), by_row_there(0, 0, 0), by_column_there(0, 0, 0);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      sky += places[i][j] * (by_u[i] * by_v[j]);
      by_row_there += places[i][j] * (slope_u[i] * by_v[j]);
      by_column_there += places[i][j] * (by_u[i] * slope_v[j]);
    }
  return {middle + V3d(sky), V3d(by_row_there) / half_rows, V3d(by_column_there) / half_columns};
}

KerrPoints::Sample KerrPoints::sample(double row, double column) const {
  const KerrChart::Direction n = chart_.direction(row, column);
  return {chart_.value(row, column),
          std::abs(n.by_row * std::sin(n.delta)) * 2 * pi / chart_.columns(),
          chart_.frequency_ratio(n.delta, n.eta)};
}

KerrPoints::KerrPoints(const KerrChart& chart, double sine, double cosine)
    : chart_(chart), sine_(sine), cosine_(cosine), bins_(kRings * kSectors) {
  constexpr double kHalf = kLargest / 2;
  for (double row = kHalf; row < chart.rows(); row += kLargest)
    for (double column = kHalf; column < chart.columns(); column += kLargest) {
      Net net{row, column, kHalf, kHalf, {}};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          net.samples[i][j] = sample(row + (static_cast<double>(i) - 1) * kHalf,
                                     column + (static_cast<double>(j) - 1) * kHalf);
      add(net);
    }
  for (std::vector<int>& bin : bins_)
    std::sort(bin.begin(), bin.end(), [this](int a, int b) {
      return cells_[static_cast<std::size_t>(a)].light > cells_[static_cast<std::size_t>(b)].light;
    });
}

// Adds both halves of a rectangle, which have six of their places from it.
void KerrPoints::split(const Net& net, bool by_rows) {
  for (const int side : {-1, 1}) {
    Net half = net;
    const std::size_t outer = side < 0 ? 0 : 2, inner = 2 - outer;
    (by_rows ? half.row : half.column) += side * (by_rows ? net.half_rows : net.half_columns) / 2;
    (by_rows ? half.half_rows : half.half_columns) /= 2;
    for (std::size_t k = 0; k < 3; ++k) {
      const double along = static_cast<double>(k) - 1;
      if (by_rows) {
        half.samples[outer][k] = net.samples[outer][k];
        half.samples[inner][k] = net.samples[1][k];
        half.samples[1][k] = sample(half.row, half.column + along * half.half_columns);
      } else {
        half.samples[k][outer] = net.samples[k][outer];
        half.samples[k][inner] = net.samples[k][1];
        half.samples[k][1] = sample(half.row + along * half.half_rows, half.column);
      }
    }
    add(half);
  }
}

void KerrPoints::add(const Net& net) {
  if (chart_.error(net.row, net.column) > kLost * chart_.stride()) return;
  const double smallest = kSmallest / chart_.stride(), wound = kWound * chart_.stride();
  bool turned = false, straight = false;
  double least_area = HUGE_VAL, longest = 0, view = 0, ratio = 0;
  for (const auto& row : net.samples)
    for (const Sample& sample : row) {
      const V3d area = sample.at.by_row.cross(sample.at.by_column);
      least_area = std::min(least_area, area.length());
      longest = std::max({longest, sample.at.by_row.length2(), sample.at.by_column.length2()});
      (area.dot(sample.at.sky) > 0 ? turned : straight) = true;
      view = std::max(view, sample.view), ratio = std::max(ratio, sample.frequency_ratio);
    }
  if (longest > wound * wound) return;
  Cell cell;
  cell.row = net.row, cell.column = net.column;
  cell.half_rows = net.half_rows, cell.half_columns = net.half_columns;
  cell.folded = turned && straight;
  set_inverse(cell, net);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      cell.places[i][j] = Imath::V3f(net.samples[i][j].at.sky - cell.middle);
  const bool rows = net.half_rows > smallest / 2, columns = net.half_columns > smallest / 2;
  const bool uneven = !(cell.off_row < 2 * kUneven * net.half_rows &&
                        cell.off_column < 2 * kUneven * net.half_columns);
  // Between the places that were looked at there may be a caustic, where light has no bound.
  const double light = view / std::max(least_area, 1e-300) * ratio * ratio * ratio * ratio;
  if (!(light > kFaintest)) return;
  if ((cell.folded || uneven) && (rows || columns))
    return split(net, rows && (!columns || net.bend(true) > net.bend(false)));
  cell.light = static_cast<float>(std::min(2 * light, 1e30));
  cell.off_row = static_cast<float>(1.02 * net.half_rows + 1.3 * cell.off_row);
  cell.off_column = static_cast<float>(1.02 * net.half_columns + 1.3 * cell.off_column);
  if (cell.folded) set_box(cell);
  most_light_ = std::max(most_light_, static_cast<double>(cell.light));
  cells_.push_back(cell);
  put_in_bins(net);
}

// Sets the inverse of its derivatives, by how much it is off, and the radius.
void KerrPoints::set_inverse(Cell& cell, const Net& net) const {
  const KerrChart::Value& centre = net.samples[1][1].at;
  const V3d &d = centre.by_row, &e = centre.by_column;
  cell.middle = centre.sky;
  const double dd = d.dot(d), ee = e.dot(e), de = d.dot(e), det = dd * ee - de * de;
  if (det > 0) cell.by_row = (d * ee - e * de) / det, cell.by_column = (e * dd - d * de) / det;
  double off_row = 0, off_column = 0, radius = 0;
  for (const int i : {-1, 0, 1})
    for (const int j : {-1, 0, 1}) {
      const V3d& at = net.sky(i, j);
      radius = std::max(radius, (at - cell.middle).length());
      off_row = std::max(off_row, std::abs(at.dot(cell.by_row) - i * cell.half_rows));
      off_column = std::max(off_column, std::abs(at.dot(cell.by_column) - j * cell.half_columns));
    }
  cell.off_row = static_cast<float>(off_row), cell.off_column = static_cast<float>(off_column);
  cell.radius = static_cast<float>(1.1 * radius);
}

// Puts the last cell into all bins that its places reach.
void KerrPoints::put_in_bins(const Net& net) {
  // Between the places a cell may be bent outwards.
  constexpr double kWider = 0.1;
  const Cell& cell = cells_.back();
  double low = 1, high = -1, first = 0, last = 0;
  const double azimuth = std::atan2(cell.middle.y, cell.middle.x);
  for (const auto& row : net.samples)
    for (const auto& [at, view, ratio] : row) {
      low = std::min(low, at.sky.z), high = std::max(high, at.sky.z);
      const double on = std::remainder(std::atan2(at.sky.y, at.sky.x) - azimuth, 2 * pi);
      first = std::min(first, on), last = std::max(last, on);
    }
  const double bend = net.bend(true) + net.bend(false);
  const double angle = 2 * std::asin(std::min(1.0, cell.radius / 2.0));
  const double polar_angle = std::acos(std::clamp(std::abs(cell.middle.z), 0.0, 1.0));
  const double wider = kWider * (high - low) + bend;
  const int bottom = ring_of(polar_angle < angle && cell.middle.z < 0 ? -1 : low - wider),
            top = ring_of(polar_angle < angle && cell.middle.z > 0 ? 1 : high + wider);
  const double aside =
      kWider * (last - first) + bend / std::max(std::sin(polar_angle) - angle, 1e-9);
  const bool all = polar_angle < angle || last - first + 2 * aside > 1.9 * pi;
  const int begin = all ? 0 : sector_of(azimuth + first - aside);
  const int count =
      all ? kSectors : (sector_of(azimuth + last + aside) - begin + kSectors) % kSectors + 1;
  const int number = static_cast<int>(cells_.size()) - 1;
  for (int ring = bottom; ring <= top; ++ring)
    for (int k = 0; k < count; ++k)
      bins_[static_cast<std::size_t>(ring * kSectors + (begin + k) % kSectors)].push_back(number);
}

// A cell that is folded over has a box, along its longer side on the sky, that holds it.
void KerrPoints::set_box(Cell& cell) const {
  const KerrChart::Value centre = chart_.value(cell.row, cell.column);
  const bool rows = centre.by_row.length2() * cell.half_rows * cell.half_rows >
                    centre.by_column.length2() * cell.half_columns * cell.half_columns;
  cell.by_row = (rows ? centre.by_row : centre.by_column).normalized();
  cell.by_column = centre.sky.cross(cell.by_row);
  double long_side = 0, short_side = 0;
  for (int k = 0; k < 25; ++k) {
    const int i = k / 5 - 2, j = k % 5 - 2;
    const V3d at =
        chart_.value(cell.row + i * cell.half_rows / 2, cell.column + j * cell.half_columns / 2)
            .sky;
    long_side = std::max(long_side, std::abs(at.dot(cell.by_row)));
    short_side = std::max(short_side, std::abs(at.dot(cell.by_column)));
  }
  cell.off_row = static_cast<float>(1.1 * long_side);
  cell.off_column = static_cast<float>(1.2 * short_side);
}

// Moves on by a step of Newton's method towards a place.  Returns by how many rows and columns, or nothing
// where there is no step, or where it leads away from the cell.
std::optional<std::array<double, 2>> KerrPoints::step(const V3d& place, const Cell& cell,
                                                      Found& at) {
  const auto by = parts_along(place - at.value.sky * place.dot(at.value.sky), at.value.by_row,
                              at.value.by_column);
  if (!by) return std::nullopt;
  const auto [by_row, by_column] = *by;
  const double most_rows = 0.6 * cell.half_rows, most_columns = 0.6 * cell.half_columns;
  at.row += std::clamp(by_row, -most_rows, most_rows);
  at.column += std::clamp(by_column, -most_columns, most_columns);
  if (cell.from_middle(at.row, at.column) > 2) return std::nullopt;
  return std::array{std::abs(by_row), std::abs(by_column)};
}

// Newton's method on the parabolas through the places of a cell, which are much quicker than the chart and
// near enough to tell that a place has no image there.
bool KerrPoints::approach(const V3d& place, const Cell& cell, Found& at) {
  double nearest = HUGE_VAL;
  for (int k = 0; k < 8; ++k) {
    at.value = cell.value(at.row, at.column);
    nearest = std::min(nearest, (place - at.value.sky * place.dot(at.value.sky)).length());
    const auto by = step(place, cell, at);
    if (!by) return false;
    if ((*by)[0] < 0.1 * cell.half_rows && (*by)[1] < 0.1 * cell.half_columns)
      return cell.from_middle(at.row, at.column) < kNearby;
  }
  return nearest < kByCaustic * cell.radius;
}

// Newton's method from one place of a cell.  Returns whether it comes to an image in the cell.
bool KerrPoints::find(const V3d& place, const Cell& cell, Found& at) const {
  if (!approach(place, cell, at)) return false;
  // Images on the rim of a cell are found in both.
  constexpr double kRim = 1e-6;
  for (int k = 0; k < 16; ++k) {
    at.value = chart_.value(at.row, at.column);
    const auto by = step(place, cell, at);
    if (!by) return false;
    // The next step would be its square.
    if ((*by)[0] < 1e-5 && (*by)[1] < 1e-5)
      return cell.from_middle(at.row, at.column) < 1 + kRim && place.dot(at.value.sky) > 0;
  }
  return false;
}

void KerrPoints::list_images(const V3d& source, double blur, double least_light,
                             std::vector<SkyImage>& images) const {
  const V3d place(source.x * sine_ + source.y * cosine_, source.z,
                  source.x * cosine_ - source.y * sine_);
  const std::size_t begin = images.size();
  const auto append = [&](const Found& at) {
    const KerrChart::Direction n = chart_.direction(at.row, at.column);
    double view = std::abs(n.by_row) * std::sin(n.delta) * 2 * pi / chart_.columns();
    double seen = at.value.by_row.cross(at.value.by_column).length();
    const double s = std::sin(n.delta);
    // Neither of the two scales is more than this.
    double stretched = std::hypot(at.value.by_row.length() / n.by_row,
                                  at.value.by_column.length() * chart_.columns() / (2 * pi * s));
    SkyImage image;
    image.direction.v = {-std::cos(n.delta), -s * std::cos(n.eta), -s * std::sin(n.eta)};
    for (std::size_t k = begin; k < images.size(); ++k)
      if ((images[k].direction.v - image.direction.v).length() < 1e-9) return;
    image.frequency_ratio = chart_.frequency_ratio(n.delta, n.eta);
    // The solid angle of a cell in the view over that on the sky.  Both are 0 at the end of the view.
    if (s < 0.02) {
      const KerrChart::Place place_there = chart_.place(n.delta, n.eta, chart_.edge(n.eta));
      view = 1, seen = place_there.by_delta.cross(place_there.across).length();
      stretched = std::hypot(place_there.by_delta.length(), place_there.across.length());
    }
    // On a caustic it is as small as a source is wide.
    image.amplification = view / std::hypot(seen, 0.5 * blur * view);
    image.speed = stretched * view / std::max(seen, 1e-9 * view);
    images.push_back(image);
  };
  for (const int number : bins_[static_cast<std::size_t>(
           ring_of(place.z) * kSectors + sector_of(std::atan2(place.y, place.x)))]) {
    const Cell& cell = cells_[static_cast<std::size_t>(number)];
    if (cell.light < least_light) break;
    const double down = place.dot(cell.by_row), on = place.dot(cell.by_column);
    if (std::abs(down) > cell.off_row || std::abs(on) > cell.off_column) continue;
    if ((cell.middle - place).length2() > cell.radius * cell.radius) continue;
    if (cell.folded) {
      // On both sides of a caustic there may be images.
      for (const double i : {-0.6, 0.6})
        for (const double j : {-0.6, 0.6}) {
          Found at{cell.row + i * cell.half_rows, cell.column + j * cell.half_columns, {}};
          if (find(place, cell, at)) append(at);
        }
      continue;
    }
    Found at{cell.row + std::clamp(down, -cell.half_rows, cell.half_rows),
             cell.column + std::clamp(on, -cell.half_columns, cell.half_columns),
             {}};
    if (find(place, cell, at)) append(at);
  }
}

SkyImage KerrPoints::image(const V3d& source, int order, double blur) const {
  // One order after another is asked for.
  struct Listed {
    const KerrPoints* of = nullptr;
    V3d source{0, 0, 0};
    std::vector<SkyImage> images{};
  };
  thread_local Listed listed;
  std::vector<SkyImage>& images = listed.images;
  if (listed.of != this || listed.source != source) {
    images.clear();
    list_images(source, blur, 0, images);
    std::sort(images.begin(), images.end(), [](const SkyImage& a, const SkyImage& b) {
      return a.amplification > b.amplification;
    });
    listed.of = this, listed.source = source;
  }
  if (static_cast<std::size_t>(order) >= images.size()) return {{V3d(-1, 0, 0)}, 1, 0};
  return images[static_cast<std::size_t>(order)];
}

}  // namespace domefall
