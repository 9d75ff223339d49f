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
// So are those whose places are not known to so many radians: the crowded images next to the flat side
// of a hole that spins nearly as fast as it can.
constexpr double kLost = 0.1;
// Where the chart is rough, exact rays find the images that have more than kBright of their
// star's light, and where not to kDoubtful, they tell whether there is a fainter one at all.
constexpr double kBright = 1e-2, kDoubtful = 1e-3;
// There two cells may have an image on their rim as far apart as this part of a cell.
constexpr double kRoughRim = 0.05;
// Cells are halved down to the smallest where a caustic goes through them, or where they are not even to
// this part of their size.
constexpr double kUneven = 0.4, kSmallest = 0.3;

int ring_of(double z) { return std::clamp(static_cast<int>((z + 1) / 2 * kRings), 0, kRings - 1); }
int sector_of(double azimuth) {
  const double turns = azimuth / (2 * pi);
  return std::clamp(static_cast<int>((turns - std::floor(turns)) * kSectors), 0, kSectors - 1);
}

}  // namespace

KerrPoints::KerrPoints(const KerrChart& chart, double sine, double cosine)
    : chart_(chart), sine_(sine), cosine_(cosine), bins_(kRings * kSectors) {
  for (int row = 0; row < chart.rows(); ++row)
    for (int column = 0; column < chart.columns(); ++column)
      if (chart.error(row, column) < kLost) add(row + 0.5, column + 0.5, 1);
  for (std::vector<int>& bin : bins_)
    std::sort(bin.begin(), bin.end(), [this](int a, int b) {
      return cells_[static_cast<std::size_t>(a)].light > cells_[static_cast<std::size_t>(b)].light;
    });
}

void KerrPoints::add(double row, double column, double size) {
  const KerrChart::Value centre = chart_.value(row, column);
  Cell cell{row, column, size, 0, centre.sky, {}, {}, 0, 0, 0};
  cell.rough = chart_.error(row, column) > KerrChart::kRough;
  const V3d &d = centre.by_row, &e = centre.by_column;
  const double dd = d.dot(d), ee = e.dot(e), de = d.dot(e), det = dd * ee - de * de;
  if (!(det > 0)) return;
  cell.by_row = (d * ee - e * de) / det, cell.by_column = (e * dd - d * de) / det;
  double off_row = 0, off_column = 0;
  bool turned = false, straight = false;
  double radius = 0, least_area = HUGE_VAL, view = 0, ratio = 0;
  for (int k = 0; k < 9; ++k) {
    const int i = k / 3 - 1, j = k % 3 - 1;
    const double down = i * size / 2, on = j * size / 2;
    const KerrChart::Value at = chart_.value(row + down, column + on);
    const KerrChart::Direction n = chart_.direction(row + down, column + on);
    radius = std::max(radius, (at.sky - cell.middle).length());
    off_row = std::max(off_row, std::abs(at.sky.dot(cell.by_row) - down));
    off_column = std::max(off_column, std::abs(at.sky.dot(cell.by_column) - on));
    least_area = std::min(least_area, at.by_row.cross(at.by_column).length());
    (at.by_row.cross(at.by_column).dot(at.sky) > 0 ? turned : straight) = true;
    // The solid angle of view of one cell of the chart there.
    view = std::max(view, std::abs(n.by_row * std::sin(n.delta)) * 2 * pi / chart_.columns());
    ratio = std::max(ratio, chart_.frequency_ratio(n.delta, n.eta));
  }
  cell.folded = turned && straight;
  if ((cell.folded || std::max(off_row, off_column) > kUneven * size) && size > kSmallest) {
    for (const double down : {-0.25, 0.25})
      for (const double on : {-0.25, 0.25}) add(row + down * size, column + on * size, size / 2);
    return;
  }
  const double shift4 = ratio * ratio * ratio * ratio;
  // Between the places that were looked at there may be a caustic, where light has no bound.
  const double light = view / std::max(least_area, 1e-300) * shift4;
  if (!(light > kFaintest)) return;
  cell.light = static_cast<float>(std::min(2 * light, 1e30));
  cell.radius = static_cast<float>(1.1 * radius);
  cell.off_row = static_cast<float>(0.51 * size + 1.3 * off_row);
  cell.off_column = static_cast<float>(0.51 * size + 1.3 * off_column);
  if (cell.folded) set_box(cell);
  most_light_ = std::max(most_light_, static_cast<double>(cell.light));
  const int number = static_cast<int>(cells_.size());
  cells_.push_back(cell);
  // All bins within the cap.
  const double angle = 2 * std::asin(std::min(1.0, cell.radius / 2.0));
  const double latitude = std::asin(std::clamp(cell.middle.z, -1.0, 1.0));
  const double low = std::sin(std::max(-pi / 2, latitude - angle)),
               high = std::sin(std::min(pi / 2, latitude + angle));
  const double azimuth = std::atan2(cell.middle.y, cell.middle.x);
  const bool polar = std::abs(latitude) + angle >= pi / 2;
  const double wide = polar ? pi : std::asin(std::min(1.0, std::sin(angle) / std::cos(latitude)));
  const int first = sector_of(azimuth - wide), last = sector_of(azimuth + wide);
  const int count = polar || 2 * wide > 2 * pi * (kSectors - 1) / kSectors
                        ? kSectors
                        : (last - first + kSectors) % kSectors + 1;
  for (int ring = ring_of(low); ring <= ring_of(high); ++ring)
    for (int k = 0; k < count; ++k)
      bins_[static_cast<std::size_t>(ring * kSectors + (first + k) % kSectors)].push_back(number);
}

// A cell that is folded over has a box, along its longer side on the sky, that holds it.
void KerrPoints::set_box(Cell& cell) const {
  const KerrChart::Value centre = chart_.value(cell.row, cell.column);
  const bool rows = centre.by_row.length2() > centre.by_column.length2();
  cell.by_row = (rows ? centre.by_row : centre.by_column).normalized();
  cell.by_column = centre.sky.cross(cell.by_row);
  double long_side = 0, short_side = 0;
  for (int k = 0; k < 25; ++k) {
    const int i = k / 5 - 2, j = k % 5 - 2;
    const V3d at = chart_.value(cell.row + i * cell.size / 4, cell.column + j * cell.size / 4).sky;
    long_side = std::max(long_side, std::abs(at.dot(cell.by_row)));
    short_side = std::max(short_side, std::abs(at.dot(cell.by_column)));
  }
  cell.off_row = static_cast<float>(1.1 * long_side);
  cell.off_column = static_cast<float>(1.2 * short_side);
}

// Newton's method from one place of a cell.  Returns whether it comes to an image in the cell.
bool KerrPoints::find(const V3d& place, const Cell& cell, Found& at) const {
  // Images on the rim of a cell are found in both.
  const double rim = cell.rough ? kRoughRim : 1e-7;
  for (int step = 0; step < 16; ++step) {
    at.value = chart_.value(at.row, at.column);
    const auto by = parts_along(place - at.value.sky * place.dot(at.value.sky), at.value.by_row,
                                at.value.by_column);
    if (!by) return false;
    const auto [by_row, by_column] = *by;
    const double most = 0.3 * cell.size;
    at.row += std::clamp(by_row, -most, most), at.column += std::clamp(by_column, -most, most);
    const double out = std::max(std::abs(at.row - cell.row), std::abs(at.column - cell.column));
    if (out > cell.size) return false;
    // The next step would be its square.
    if (std::abs(by_row) < 1e-5 && std::abs(by_column) < 1e-5)
      return out < 0.5 * cell.size + rim && place.dot(at.value.sky) > 0;
  }
  return false;
}

// Says whether the exact ray leads to a place.  Most of those that polynomials send far away are of no
// image at all.
bool KerrPoints::is_there(const V3d& place, const KerrChart::Direction& n) const {
  constexpr double kFarOff = 0.05;
  const double way = n.delta - chart_.edge(n.eta).delta;
  const TracedKerr ray = trace_kerr_without_area(chart_.at(), {0, n.eta, chart_.sky(), way});
  return (ray.sky - place).length() < kFarOff;
}

// Where polynomials are too far off, a bright image is found by Newton's method on exact rays, from where
// they have it.  Returns its ray, or nothing where there is none so near.
std::optional<TracedKerr> KerrPoints::meet(const V3d& place, KerrChart::Direction& n) const {
  constexpr int kSteps = 12;
  constexpr double kFarthest = 0.5;  // of the way from the edge, in one step
  double way = n.delta - chart_.edge(n.eta).delta;
  for (int step = 0; step < kSteps; ++step) {
    const TracedKerr ray = trace_kerr(chart_.at(), {0, n.eta, chart_.sky(), way});
    const auto by = parts_along(place - ray.sky * place.dot(ray.sky), ray.by_delta, ray.across);
    if (!by) return std::nullopt;
    const double by_delta = (*by)[0], by_eta = (*by)[1] / std::sin(n.delta);
    const double before = chart_.edge(n.eta).delta, turned = std::clamp(by_eta, -0.05, 0.05);
    n.eta += turned;
    const double moved = by_delta - (chart_.edge(n.eta).delta - before),
                 most = kFarthest * std::abs(way);
    way += std::clamp(moved, -most, most);
    n.delta = chart_.edge(n.eta).delta + way;
    if (std::abs(by_delta) < 1e-7 * std::abs(way) && std::abs(by_eta) < 1e-7)
      return place.dot(ray.sky) > 0 ? std::optional(ray) : std::nullopt;
  }
  return std::nullopt;
}

void KerrPoints::list_images(const V3d& source, double blur, double least_light,
                             std::vector<SkyImage>& images) const {
  const V3d place(source.x * sine_ + source.y * cosine_, source.z,
                  source.x * cosine_ - source.y * sine_);
  const std::size_t begin = images.size();
  std::vector<std::array<double, 2>> rough;  // rows and columns of images in rough cells
  const auto append = [&](const Found& at) {
    KerrChart::Direction n = chart_.direction(at.row, at.column);
    double view = std::abs(n.by_row) * std::sin(n.delta) * 2 * pi / chart_.columns();
    double seen = at.value.by_row.cross(at.value.by_column).length();
    std::optional<TracedKerr> exact;
    const double error = chart_.error(at.row, at.column);
    if (error > KerrChart::kRough) {
      const auto same = [&](const std::array<double, 2>& other) {
        const double on = std::remainder(other[1] - at.column, chart_.columns());
        return std::max(std::abs(other[0] - at.row), std::abs(on)) < 2 * kRoughRim;
      };
      if (std::ranges::any_of(rough, same)) return;
      rough.push_back({at.row, at.column});
    }
    if (error > kDoubtful && !is_there(place, n)) return;
    if (error > KerrChart::kRough && view > kBright * seen && !(exact = meet(place, n))) return;
    const double s = std::sin(n.delta);
    SkyImage image;
    image.direction.v = {-std::cos(n.delta), -s * std::cos(n.eta), -s * std::sin(n.eta)};
    for (std::size_t k = begin; k < images.size(); ++k)
      if ((images[k].direction.v - image.direction.v).length() < 1e-9) return;
    image.frequency_ratio = chart_.frequency_ratio(n.delta, n.eta);
    // The solid angle of a cell in the view over that on the sky.  Both are 0 at the end of the view.
    if (exact) {
      view = 1, seen = 1 / exact->amplification;
    } else if (s < 0.02) {
      const KerrChart::Place place_there = chart_.place(n.delta, n.eta, chart_.edge(n.eta));
      view = 1, seen = place_there.by_delta.cross(place_there.across).length();
    }
    // On a caustic it is as small as a source is wide.
    image.amplification = view / std::hypot(seen, 0.5 * blur * view);
    images.push_back(image);
  };
  for (const int number : bins_[static_cast<std::size_t>(
           ring_of(place.z) * kSectors + sector_of(std::atan2(place.y, place.x)))]) {
    const Cell& cell = cells_[static_cast<std::size_t>(number)];
    if (cell.light < least_light) break;
    if ((cell.middle - place).length2() > cell.radius * cell.radius) continue;
    const double down = place.dot(cell.by_row), on = place.dot(cell.by_column);
    if (std::abs(down) > cell.off_row || std::abs(on) > cell.off_column) continue;
    if (cell.folded) {
      // On both sides of a caustic there may be images.
      for (const double i : {-0.3, 0.3})
        for (const double j : {-0.3, 0.3}) {
          Found at{cell.row + i * cell.size, cell.column + j * cell.size, {}};
          if (find(place, cell, at)) append(at);
        }
      continue;
    }
    const double half = cell.size / 2;
    Found at{
        cell.row + std::clamp(down, -half, half), cell.column + std::clamp(on, -half, half), {}};
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
