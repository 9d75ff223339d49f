// These functions of RayGrid trace the rays of its nodes and store what is needed of them.
#include <algorithm>
#include <cmath>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/render/rays/footprint_batch.h"
#include "pipeline/render/sky/ray_grid.h"
#include "projections/pixel_directions.h"

namespace domefall {
namespace {

// Up to this phase floats hold phases to kPhaseTolerance.  They hold directions on the sky to
// kLeastTolerance (radians).  That matters because the borders of a grid are sharp however small a
// pixel is on it.
constexpr float kLargestPhase = 1024, kLeastTolerance = 6e-8f;

// Converts kTolerance to radians on the sky by the shorter side of each footprint.  On an Einstein
// ring that side is 0, so at least a tenth of the longer side counts.
[[gnu::always_inline]] inline void set_tolerances_loop(const float* wide, const float* narrow,
                                                       int count, float* tolerance) {
  constexpr float kNarrowest = 0.1f;
  for (int k = 0; k < count; ++k) {
    const float least = kNarrowest * wide[k];
    tolerance[k] =
        static_cast<float>(RayGrid::kTolerance) * (narrow[k] > least ? narrow[k] : least);
  }
}
Dispatched<set_tolerances_loop> set_tolerances;

}  // namespace

// Returns the range of a row's nodes on which cells with pixels in the image depend.  A dome needs
// only those around its disc.
std::pair<int, int> RayGrid::needed_nodes(int row) const {
  if (!traits_of(projection_).half_sphere) return {0, node_columns_};
  // Cells with pixels in the disc depend on nodes up to kMargin + 1 steps beyond it.
  const double middle = (columns(projection_) - 1) / 2.0;
  const double y =
      std::max(std::abs((row - kMargin) * kStep - middle) - (kMargin + 1) * kStep, 0.0);
  const double half = std::sqrt(std::max(middle * middle - y * y, 0.0)) + (kMargin + 2) * kStep;
  return {std::clamp(static_cast<int>((middle - half) / kStep) + kMargin, 0, node_columns_),
          std::clamp(static_cast<int>((middle + half) / kStep) + kMargin + 1, 0, node_columns_)};
}

void RayGrid::trace_row(int row) {
  ViewRayBatch rays;
  std::array<CameraDirection, ViewRayBatch::kSize> n;
  ViewRayBatch::Column<double> i, j, angle;
  j.fill((row - kMargin) * kStep + 1.0);
  const auto [from, to] = needed_nodes(row);
  for (int first = from; first < to; first += ViewRayBatch::kSize) {
    const int count = std::min(ViewRayBatch::kSize, to - first);
    for (int k = 0; k < count; ++k) i[k] = (first + k - kMargin) * kStep + 1.0;
    find_directions(projection_, i.data(), j.data(), count, n.data(), angle.data());
    shader_->scene().tracer.trace(n.data(), count, rays);
    store_nodes(at(row, first), rays, angle.data(), count);
  }
  // The mark of a run says at once whether the nodes of a row on which a cell depends see one sky.
  const std::uint8_t* sky = sky_.data() + at(row, 0);
  std::uint8_t* run = run_.data() + at(row, 0);
  for (int k = 0; k < cell_columns_; ++k) {
    bool same = true;
    for (int m = 1; m < 2 * kMargin + 2; ++m) same &= sky[k + m] == sky[k];
    run[k] = same ? sky[k] : kMixed;
  }
}

void RayGrid::store_nodes(std::size_t first, const ViewRayBatch& rays, const double* angle,
                          int count) {
  const auto column = [&](Quantity q) { return &nodes_[q][first]; };
  PerSky<std::uint8_t> marks{};
  for (const SkyRegion sky : kEverySky)
    marks[sky] = shader_->scene().background[sky] ? static_cast<std::uint8_t>(sky) : kDark;
  bool any_light = false;
  for (int k = 0; k < count; ++k) {
    const std::uint8_t mark = marks[rays.sky[k]];
    sky_[first + k] = mark;
    edge_[first + k] = static_cast<float>(rays.to_edge[k] / (angle[k] * kStep));
    any_light |= mark < kDark;
  }
  // Nodes of dark skies need nothing else.
  if (!any_light) return;
  set_footprints(rays, angle, count,
                 {column(kX), column(kY), column(kZ), column(kWide), column(kNarrow),
                  column(kAxisX), column(kAxisY), column(kAxisZ)});
  store_rings(first, rays, angle, count);
  set_tolerances(column(kWide), column(kNarrow), count, &tolerance_[first]);
  store_shifts(first, rays, count);
}

// Stores the phases of rays that end on rings.  A phase takes the place of a direction: it is the
// component at right angles to a unit vector, so that check_loop() measures the errors of both in
// the same way.
void RayGrid::store_rings(std::size_t first, const ViewRayBatch& rays, const double* angle,
                          int count) {
  const FormulaShader* rings = shader_->formula(SkyRegion::kIV);
  if (rings == nullptr || shader_->scene().background[SkyRegion::kIV]->is_grid()) return;
  for (int k = 0; k < count; ++k) {
    if (rays.sky[k] != SkyRegion::kIV) continue;
    const std::size_t at = first + static_cast<std::size_t>(k);
    const auto [phase, width] =
        rings->ring_node(rays.emission_time[k], rays.time_scale[k], angle[k]);
    nodes_[kX][at] = phase;
    nodes_[kY][at] = 0;
    nodes_[kZ][at] = 1;
    nodes_[kWide][at] = width;
    // From this width set_tolerances() makes a tolerance of at least kPhaseTolerance.
    nodes_[kNarrow][at] =
        std::max(width, FormulaShader::kPhaseTolerance / static_cast<float>(kTolerance));
    nodes_[kGain][at] = nodes_[kTone][at] = 1;
    // Floats hold larger phases too coarsely.
    cubic_[at] = std::abs(phase) < kLargestPhase;
  }
}

// Stores shifts and filters.  For a colour panorama the shift is stored as the gains of its two
// sides.
void RayGrid::store_shifts(std::size_t first, const ViewRayBatch& rays, int count) {
  ViewRayBatch::Column<float> gain, tone;
  ViewRayBatch::Column<SampleFilter> filters;
  for (const SkyRegion sky : kEverySky) {
    const auto end = rays.sky.begin() + count;
    if (std::find(rays.sky.begin(), end, sky) == end) continue;
    const auto& background = shader_->scene().background[sky];
    if (background && background->is_grid()) {
      for (int k = 0; k < count; ++k) {
        if (rays.sky[k] != sky) continue;
        const LightShift shift = background->grid_shift(rays.frequency_ratio[k]);
        nodes_[kGain][first + k] = shift.gain;
        nodes_[kTone][first + k] = shift.tone;
        // Where floats round more coarsely than the tolerance, pixels are traced.
        cubic_[first + k] = tolerance_[first + k] >= kLeastTolerance;
      }
      continue;
    }
    const SkySampler* sampler = shader_->sampler(sky);
    if (sampler == nullptr) continue;
    sampler->choose_filters(&nodes_[kWide][first], &nodes_[kNarrow][first], count,
                            SkySampler::kMostTaps, HUGE_VALF, filters.data());
    const SkyLight& light = *background;
    const double* g = rays.frequency_ratio.data();
    if (sampler->map().kind() == SkyMapKind::kThermal)
      light.shifts(g, count, gain.data(), tone.data());
    else
      light.shift_sides(g, count, gain.data(), tone.data());
    for (int k = 0; k < count; ++k) {
      if (rays.sky[k] != sky) continue;
      nodes_[kGain][first + k] = gain[k];
      nodes_[kTone][first + k] = tone[k];
      filters_[first + k] = filters[k];
    }
  }
}

}  // namespace domefall
