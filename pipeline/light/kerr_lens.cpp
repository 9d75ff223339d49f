#include "pipeline/light/kerr_lens.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/light/kerr_body_image.h"
#include "pipeline/light/kerr_ergosphere.h"
#include "pipeline/light/kerr_points.h"
#include "pipeline/light/kerr_sphere_image.h"
#include "pipeline/light/kerr_view.h"

namespace domefall {
namespace {

using std::numbers::pi;

// The corners of a border, and of a ring.
constexpr int kCorners = 4096, kRingCorners = 1024;

// Returns the corners of a curve, counter-clockwise about -R as seen from where the directions begin.
template <class Delta>
std::vector<V3d> corners_of(int count, const Delta& delta) {
  std::vector<V3d> corners;
  corners.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    const double eta = -2 * pi * k / count;
    corners.push_back(kerr_view(delta(eta), eta));
  }
  return corners;
}

// Returns where the image of the sky is turned over first, on the way from the far end of the view to
// the edge.
double first_critical_delta(const KerrChart& chart, double eta) {
  const double column = eta * chart.columns() / (2 * pi);
  const auto turned_over = [&](double row) {
    const KerrChart::Value at = chart.value(row, column);
    return at.sky.dot(at.by_row.cross(at.by_column)) > 0;
  };
  double far = chart.rows() - 0.5, near = far;
  const bool first = turned_over(far);
  while (near > 0 && turned_over(near) == first) far = near, near -= 0.5;
  for (int k = 0; k < 30; ++k) {
    const double middle = (far + near) / 2;
    (turned_over(middle) == first ? far : near) = middle;
  }
  return chart.direction(far, column).delta;
}

// Fills in the derivative by its singular values.
void set_derivative(const V3d& d, const V3d& e, const ViewAxes& view, const V3d& sky,
                    ViewRay& ray) {
  const double dd = d.dot(d), ee = e.dot(e), de = d.dot(e);
  const double angle = std::atan2(2 * de, dd - ee) / 2, c = std::cos(angle), s = std::sin(angle);
  const V3d longest = d * c + e * s;
  ray.axis = view.by_delta * c + view.across * s;
  ray.scale_along = longest.length();
  ray.along = ray.scale_along > 0 ? longest / ray.scale_along : V3d(0, 0, 0);
  const V3d other = e * c - d * s;
  ray.scale_across = other.length();
  // by_delta x across is -n: the view looks along n.
  ray.mirrored = sky.cross(ray.along).dot(other) > 0;
}

}  // namespace

KerrPlace kerr_place(const SpinningHole& hole, const ObserverState& observer) {
  return {hole.kerr, observer.r, polar_angle(observer, hole)};
}

KerrLens::KerrLens(std::shared_ptr<const KerrCharts> charts, const M33d& sky_from_tetrad)
    : charts_(std::move(charts)),
      sine_(std::sin(static_cast<double>(charts_->at.theta))),
      cosine_(std::cos(static_cast<double>(charts_->at.theta))) {
  const V3d r = column(sky_from_tetrad, 0), theta = column(sky_from_tetrad, 1);
  axes_ = from_columns(r * sine_ + theta * cosine_, column(sky_from_tetrad, 2),
                       r * cosine_ - theta * sine_);
}

const KerrChart* KerrLens::chart(SkyRegion sky) const {
  return sky == SkyRegion::kI     ? charts_->own.get()
         : sky == SkyRegion::kIII ? charts_->beyond.get()
                                  : nullptr;
}

// Where a direction comes from.
struct KerrLens::Seen {
  double delta, eta, to_edge = HUGE_VAL;
  const KerrChart* chart = nullptr;
  KerrChart::Edge edge{};
};

KerrLens::Seen KerrLens::seen(const V3d& n) const {
  const KerrDirection towards = kerr_direction_of(n);
  Seen seen{static_cast<double>(towards.delta), static_cast<double>(towards.eta)};
  const double sine = std::max(std::hypot(n.y, n.z), 1e-3);
  for (const KerrChart* one : {charts_->own.get(), charts_->beyond.get()}) {
    if (!one) continue;
    const KerrChart::Edge edge = one->edge(seen.eta);
    const double away = seen.delta - edge.delta;
    seen.to_edge = std::min(seen.to_edge, std::abs(away) / std::hypot(1, edge.slope / sine));
    if ((one->end() > 0) == (away > 0) && away != 0) seen.chart = one, seen.edge = edge;
  }
  return seen;
}

void KerrLens::rays(const DirectionBatch& n, int count, ViewRayBatch& batch) const {
  for (int k = 0; k < count; ++k) {
    const Seen at = seen({n.x[k], n.y[k], n.z[k]});
    batch.to_edge[k] = at.to_edge;
    batch.emission_time[k] = batch.time_scale[k] = 0;
    if (!at.chart) {
      batch.sky[k] = SkyRegion::kIV;
      batch.sky_x[k] = batch.sky_y[k] = batch.sky_z[k] = 0;
      batch.along_x[k] = batch.along_y[k] = batch.along_z[k] = 0;
      batch.scale_along[k] = batch.scale_across[k] = 0;
      batch.frequency_ratio[k] = 1;
      continue;
    }
    batch.sky[k] = at.chart->sky() == KerrEdge::kSilhouette ? SkyRegion::kI : SkyRegion::kIII;
    const KerrChart::Place place = at.chart->place(at.delta, at.eta, at.edge);
    ViewRay ray;
    set_derivative(place.by_delta, place.across, ViewAxes(at.delta, at.eta), place.sky, ray);
    const V3d sky = apply(axes_, place.sky), along = apply(axes_, ray.along);
    batch.sky_x[k] = sky.x, batch.sky_y[k] = sky.y, batch.sky_z[k] = sky.z;
    batch.along_x[k] = along.x, batch.along_y[k] = along.y, batch.along_z[k] = along.z;
    batch.scale_along[k] = ray.scale_along, batch.scale_across[k] = ray.scale_across;
    batch.frequency_ratio[k] = at.chart->frequency_ratio(at.delta, at.eta);
  }
}

ViewRay KerrLens::ray(const V3d& n) const {
  const Seen at = seen(n);
  ViewRay ray;
  ray.sky_direction = V3d(0, 0, 0);
  ray.to_edge = at.to_edge;
  const auto trace = [&](double delta, double eta) {
    return trace_kerr(charts_->at, {delta, eta});
  };
  const TracedKerr exact = trace(at.delta, at.eta);
  if (exact.origin == KerrOrigin::kPastHorizon) return ray;
  ray.sky = exact.origin == KerrOrigin::kOwn ? SkyRegion::kI : SkyRegion::kIII;
  ray.known = chart(ray.sky) != nullptr;
  if (!ray.known) return ray;
  set_derivative(exact.by_delta, exact.across, ViewAxes(at.delta, at.eta), exact.sky, ray);
  ray.sky_direction = apply(axes_, exact.sky);
  ray.along = apply(axes_, ray.along);
  ray.frequency_ratio = 1 / std::abs(exact.energy);
  ray.swept = exact.swept;
  const double area = 1 / exact.amplification;
  // By how much the area changes, from two rays beside it on the sky's side.
  const double step = std::min(1e-4, at.to_edge / 16), sine = std::max(std::sin(at.delta), 1e-6);
  const auto change = [&](double delta, double eta) {
    const TracedKerr beside = trace(delta, eta);
    return beside.origin == exact.origin ? (1 / beside.amplification - area) / step : 0;
  };
  ray.bundle.patch = SkyPatch{
      area, std::hypot(change(at.delta + step, at.eta), change(at.delta, at.eta + step / sine))};
  return ray;
}

std::vector<SkyBorder> KerrLens::borders() const {
  const auto corners = [&](KerrEdge edge) {
    return corners_of(kCorners,
                      [&](double eta) { return kerr_edge_delta(charts_->at, eta, edge); });
  };
  std::vector<SkyBorder> borders{{corners(KerrEdge::kSilhouette), false, SkyRegion::kI}};
  if (charts_->at.delta() < 0)
    borders.push_back({corners(KerrEdge::kRegionThree), true, SkyRegion::kIII});
  return borders;
}

std::vector<ViewCurve> KerrLens::einstein_rings() const {
  std::vector<ViewCurve> rings;
  for (const KerrChart* one : {charts_->own.get(), charts_->beyond.get()})
    if (one)
      rings.emplace_back(
          corners_of(kRingCorners, [&](double eta) { return first_critical_delta(*one, eta); }));
  return rings;
}

std::optional<ViewCurve> KerrLens::ergosphere() const {
  if (in_ergosphere(charts_->at)) return std::nullopt;
  return ergosphere_outline(charts_->at);
}

std::unique_ptr<const SkyPoints> KerrLens::points(SkyRegion sky,
                                                  const std::optional<PointTolerance>&) const {
  const KerrChart* one = chart(sky);
  return one ? std::make_unique<KerrPoints>(*one, sine_, cosine_) : nullptr;
}

std::optional<GasView> KerrLens::gas_view() const {
  const auto edge = std::make_shared<const KerrEdgeCurve>(charts_->at, KerrEdge::kSilhouette);
  // A direction at an azimuth leads away from R on the side of (cos, sin), and at eta on the other one.
  const KerrPlace& at = charts_->at;
  return GasView{{SpinningHole{1, at.hole}, static_cast<double>(at.r), Tetrad::kRain},
                 std::nullopt,
                 at,
                 [edge](double azimuth) { return edge->at(azimuth + pi).delta; }};
}

std::vector<BodyImage> KerrLens::body_images(double null_time, const BodyMotion& motion,
                                             double radius) const {
  return kerr_body_images(charts_->at, null_time, motion, radius);
}

std::optional<BodyImage> KerrLens::body_image(double null_time, const BodyMotion& motion, int order,
                                              double radius) const {
  const std::vector<BodyImage> images = body_images(null_time, motion, radius);
  const auto k = static_cast<std::size_t>(order);
  return k < images.size() ? std::optional(images[k]) : std::nullopt;
}

RingedSphere KerrLens::sphere(double null_time, const BodyMotion& motion, const BodyImage& image,
                              std::span<const BodyImage> earlier, double radius,
                              const RingPlane& rings,
                              const std::function<double(const V3d&)>& spacing) const {
  return kerr_image_of_sphere(charts_->at, null_time, motion, image, earlier, radius, rings,
                              spacing);
}

// From the nearest of a coarse grid of rays, by Newton's method on exact rays.
V3d KerrLens::primary_image(const V3d& source) const {
  const V3d place(source.x * sine_ + source.y * cosine_, source.z,
                  source.x * cosine_ - source.y * sine_);
  constexpr int kRings = 24, kAround = 24;
  double best = -2, delta = pi, eta = 0;
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < kAround; ++j) {
      const double e = 2 * pi * j / kAround, d = pi * (i + 0.5) / kRings;
      const TracedKerr ray = trace_kerr_without_area(charts_->at, {d, e});
      if (ray.origin != KerrOrigin::kOwn) continue;
      // Farther from the hole counts a little more, so that of two images the brighter is taken.
      const double near = ray.sky.dot(place) + 0.02 * d;
      if (near > best) best = near, delta = d, eta = e;
    }
  V3d n = kerr_view(delta, eta);
  for (int step = 0; step < 30; ++step) {
    const KerrDirection towards = kerr_direction_of(n);
    const TracedKerr ray = trace_kerr(charts_->at, towards);
    if (ray.origin != KerrOrigin::kOwn) break;
    const auto by = parts_along(place - ray.sky * place.dot(ray.sky), ray.by_delta, ray.across);
    if (!by) break;
    const double length = std::hypot((*by)[0], (*by)[1]), slow = std::min(1.0, 0.2 / length);
    const ViewAxes view(static_cast<double>(towards.delta), static_cast<double>(towards.eta));
    n = (n + (view.by_delta * (*by)[0] + view.across * (*by)[1]) * slow).normalized();
    if (length < 1e-15) break;
  }
  return n;
}

}  // namespace domefall
