// Gas that light goes through, against sums of many small steps along rays that are followed in other
// coordinates, and against the disc without height.
#include "pipeline/render/disc/gas_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "pipeline/base/csv_file.h"
#include "pipeline/render/disc/disc_pass.h"
#include "pipeline/render/disc/gas_pass.h"
#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/disc/disc_light.h"
#include "tests/pipeline/render/disc/disc_views.h"
#include "tests/pipeline/render/disc/reference_disc.h"
#include "tests/sanitized.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

Vector3 numbers_of(const V3d& v) { return {v.x, v.y, v.z}; }
V3d vector_of(const Vector3& v) { return {v[0], v[1], v[2]}; }

// What a show has of each kind of gas.
struct GasCase {
  DiscView at;
  std::optional<Halo> halo{};
  std::optional<Jet> jet{};
  bool disc = true;
};

Show gas_show(const GasCase& view, const Projection& projection) {
  Show show = disc_show(view.at, projection);
  const SkyDirection normal = show.disc->normal;
  if ((show.halo = view.halo)) show.halo->normal = normal;
  if ((show.jet = view.jet)) show.jet->normal = normal;
  if (!view.disc) show.disc.reset();
  return show;
}

// A GasScene is a scene of one show, with its lens and light.
struct GasScene {
  explicit GasScene(Show shown)
      : show(std::move(shown)),
        state(frame_state(show, 0)),
        light(show.disc ? std::optional<DiscLight>(*show.disc) : std::nullopt),
        scene(show, state, plan_frame(show, state),
              lens_of(state.observer, WantedSkies{}, show.effects), {}, {},
              light ? &*light : nullptr) {}

  GasSight seen(const GasRays& rays, const CameraDirection& n) const {
    FrameRayBatch at;
    scene.tracer.into_frame(&n, 1, at);
    const double alpha =
        std::acos(std::clamp(rays.counts_from_hole() ? -at.x[0] : at.x[0], -1.0, 1.0));
    const V3d across = V3d(0, at.y[0], at.z[0]).normalized();
    return rays.sight(rays.path(alpha, across), across, at.frequency[0]);
  }

  Show show;
  FrameState state;
  std::optional<DiscLight> light;
  FrameScene scene;
};

double luminance_of(const std::array<float, 3>& c) {
  return luminance(WorkingRgb{c[0], c[1], c[2]});
}

// The luminance and what is left of one ray, by the formulas of the four-velocities.
struct Summed {
  double nits = 0, left = 1;
};

class SummedGas {
 public:
  SummedGas(const GasScene& gas, const GasCase& view) : show_(gas.show), charge_(view.at.charge) {
    const ObserverState& o = gas.state.observer;
    normal_ = view.at.normal.normalized();
    view_ = {o.r, is_outgoing(o.tetrad), numbers_of(o.celerity), numbers_of(normal_)};
    view_.charge = charge_;
    if (show_.disc) light_.emplace(*show_.disc);
  }

  Summed at(const V3d& direction) const {
    Summed sum;
    for (const ReferenceGasStep& step : reference_steps(view_, numbers_of(direction), 500, 2e-3)) {
      const V3d x = vector_of(step.place), back = vector_of(step.rate);
      const double r = x.length(), f = 1 - 2 / r + charge_ * charge_ / (r * r);
      const double s = x.dot(normal_) / r;
      // k.u of a four-velocity (u^t, v), v = dx/dtau: its part along x is stretched by 1/f.
      const auto product = [&](double ut, const V3d& v) {
        const V3d along = x / r;
        const double radial = -back.dot(along), own = v.dot(along);
        const V3d k_across = -back - along * radial, v_across = v - along * own;
        return step.energy * ut - radial * own / f - k_across.dot(v_across);
      };
      const V3d around = normal_.cross(x);
      const double before = sum.left;
      if (show_.disc) add_disc(x, s, step, product, sum);
      const double left = (before + sum.left) / 2;
      if (const auto& halo = show_.halo) {
        const double rho = r * std::sqrt(1 - s * s), l = std::pow(rho, 1.5) / (1 + rho);
        const double ut = 1 / std::sqrt(1 / f - l * l / (rho * rho));
        const double sent = product(ut / f, around * (ut * l / (rho * rho)));
        const double n = f * std::exp(-r * r / (2 * halo->r * halo->r) -
                                      s * s / (2 * halo->height * halo->height));
        sum.nits += left * n * sent * step.length * halo->luminance / halo->r *
                    brightness(halo->temperature, sent);
      }
      if (const auto& jet = show_.jet) {
        const V3d out = x / r;
        const double g = jet->lorentz;
        const double sent = product(g / std::sqrt(f), out * (std::sqrt(g * g - 1) * std::sqrt(f)));
        const double a = std::acos(std::min(1.0, std::abs(s)));
        const double horizon = 1 + std::sqrt(1 - charge_ * charge_);
        const double y = std::min(1.0, (r - horizon) / jet->r);
        const double n = std::pow(jet->r / r, 2) * y * y * (3 - 2 * y) *
                         std::exp(-a * a / (2 * jet->opening * jet->opening) -
                                  r * r / (2 * jet->length * jet->length));
        sum.nits += left * n * sent * step.length * jet->luminance / jet->r *
                    brightness(jet->temperature, sent);
      }
    }
    return sum;
  }

 private:
  static double brightness(const GasTemperature& t, double sent) {
    return t ? blackbody_xyz(*t / sent).y / blackbody_xyz(*t).y : 1 / (sent * sent * sent);
  }

  template <class Product>
  void add_disc(const V3d& x, double s, const ReferenceGasStep& step, const Product& product,
                Summed& sum) const {
    const Disc& disc = *show_.disc;
    const double r = x.length();
    if (r <= disc.inner || r >= disc.outer) return;
    const double omega = std::sqrt(r - charge_ * charge_) / (r * r);
    const double around = omega * omega * r * r * (1 - s * s);
    const double ut = 1 / std::sqrt(1 - 2 / r + charge_ * charge_ / (r * r) - around);
    const double sent = product(ut, normal_.cross(x) * (omega * ut));
    const double height = disc.height * std::pow(r / disc.outer, 0.125);
    const auto thinned = [](double t) { return t < 1 ? t * t * t * (10 - 15 * t + 6 * t * t) : 1; };
    const double depth = disc.optical_depth * thinned((1 - r / disc.outer) / disc.rim) *
                         thinned((r / disc.inner - 1) / disc.rim);
    const double per_m = depth / (std::sqrt(2 * std::numbers::pi) * height * r) *
                         std::exp(-s * s / (2 * height * height));
    const double kept = std::exp(-per_m * sent * step.length);
    sum.nits += sum.left * (1 - kept) * luminance(light_->light(r, 1 / sent));
    sum.left *= kept;
  }

  const Show& show_;
  double charge_;
  V3d normal_;
  ReferenceDiscView view_;
  std::optional<DiscLight> light_;
};

Disc slab(double height, double depth = 3) {
  Disc disc;
  disc.height = height, disc.optical_depth = depth, disc.rim = 0.2;
  return disc;
}

// Above the gas, near its plane, in it, inside the horizon, fast, in the outgoing frame, near a charge.
std::vector<GasCase> gas_views() {
  constexpr Region kI = Region::kI, kII = Region::kII;
  constexpr Tetrad kRain = Tetrad::kRain, kOut = Tetrad::kOutgoing;
  Halo halo;
  halo.luminance = 1, halo.r = 6;
  Halo warm = halo;
  warm.temperature = 4000;
  Jet jet{.lorentz = 2, .opening = 0.15, .r = 5, .length = 30, .luminance = 1};
  jet.temperature = 7000;
  const DiscView far{{kI, kRain, 30, celerity_of_rest(30)}, normal_seen_from(20), slab(0.1)};
  return {{far},
          {{{kI, kRain, 30, celerity_of_rest(30)}, normal_seen_from(1), slab(0.05)}},
          {{{kI, kRain, 12, {0.1, 0.3, 0.2}}, normal_seen_from(0.2), slab(0.2, 1)}},
          {{{kI, kOut, 9, {0.1, 0.3, 0.2}}, normal_seen_from(40), slab(0.1)}},
          {{{kII, kRain, 1.5, {0, 0, 0}}, V3d(0.3, -1, 0.2), slab(0.1)}},
          {{{kI, kRain, 15, {1, -2, 0.5}}, normal_seen_from(30), slab(0.1)}},
          {{{kI, kRain, 20, celerity_of_rest(20, 0.8)}, normal_seen_from(15), slab(0.1), 0.8}},
          {far, halo, std::nullopt, false},
          {far, warm, std::nullopt, false},
          {far, std::nullopt, jet, false},
          {far, warm, jet, true},
          {{{kI, kRain, 8, {0.2, 0.1, 0}}, normal_seen_from(70), slab(0.1)}, warm, jet, false},
          {{{kII, kRain, 1.2, {0, 0, 0}}, V3d(0.9, -0.3, 0.2), slab(0.1)}, halo, jet, false}};
}

// Beside the edge of the silhouette two rays part by e for each radian, so a ray within 1e-3 of it is
// left out.
TEST(GasRays, AreTheSumsOfSmallSteps) {
  std::mt19937 random(3);
  const std::vector<GasCase> views = gas_views();
  std::vector<double> errors;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const GasScene gas(gas_show(views[v], Stereographic{300, 200, 100 * kDegree}));
    const GasRays rays(gas.scene);
    const SummedGas summed(gas, views[v]);
    double brightest = 0;
    struct Compared {
      double seen, summed;
    };
    std::vector<Compared> compared;
    for (int k = 0; k < tries(40, 12); ++k) {
      const PixelPosition pixel{1.0 + static_cast<double>(random() % 300),
                                1.0 + static_cast<double>(random() % 200)};
      const CameraDirection n = direction_at(gas.state.projection, pixel);
      if (std::abs(gas.scene.tracer.trace(n).to_edge) < 1e-3) continue;
      const GasSight seen = gas.seen(rays, n);
      const Summed truth = summed.at(apply(gas.state.observer.tetrad_from_camera, n.v));
      compared.push_back({luminance_of(seen.light), truth.nits});
      brightest = std::max(brightest, truth.nits);
      EXPECT_NEAR(seen.left, truth.left, 3e-3) << v << " " << pixel.i << " " << pixel.j;
    }
    EXPECT_GT(brightest, 0) << v;
    for (const Compared& c : compared) {
      const double off = std::abs(c.seen - c.summed) /
                         (c.summed + 0.1 * std::max(brightest, views[v].disc ? 1e-4 : 0.1));
      errors.push_back(off);
      EXPECT_LT(off, 2.5e-3) << "view " << v << ": " << c.seen << " instead of " << c.summed;
    }
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 5e-5);
  EXPECT_LT(errors[errors.size() * 19 / 20], 5e-4);
}

// A thin slab is the disc without height, but for its own shadow and what the plane is bent by.
TEST(GasRays, OfNoHeightAreTheDisc) {
  std::mt19937 random(5);
  for (const double degrees : {80.0, 35.0, 15.0}) {
    const DiscView view{{Region::kI, Tetrad::kRain, 30, celerity_of_rest(30)},
                        normal_seen_from(degrees),
                        slab(2e-5)};
    const GasScene thick(gas_show({view}, Stereographic{300, 200, 80 * kDegree}));
    DiscView flat_view = view;
    flat_view.disc.height = 0;
    const GasScene flat(gas_show({flat_view}, Stereographic{300, 200, 80 * kDegree}));
    const GasRays rays(thick.scene);
    const DiscPass disc(flat.scene);
    const double width = 1e-6;
    int lit = 0;
    for (int k = 0; k < tries(60, 40); ++k) {
      const PixelPosition pixel{1.0 + static_cast<double>(random() % 300),
                                1.0 + static_cast<double>(random() % 200)};
      const CameraDirection n = direction_at(thick.state.projection, pixel);
      if (std::abs(thick.scene.tracer.trace(n).to_edge) < 1e-2) continue;
      const GasSight seen = thick.seen(rays, n);
      EXPECT_NEAR(seen.left, disc.left_before(n, HUGE_VAL, width), 1e-4);
      double light = 0, left = 1;
      for (const DiscPass::Place& place : disc.places(n, width)) {
        const double after = disc.left_before(n, (place.order + 1) * std::numbers::pi, width);
        light += (left - after) * luminance(flat.light->light(place.r, place.frequency_ratio));
        left = after;
      }
      lit += light > 0;
      EXPECT_NEAR(luminance_of(seen.light), light, 1e-4 * (light + 1e-3))
          << pixel.i << " " << pixel.j;
    }
    EXPECT_GT(lit, 2);
  }
}

// Another program for the same physics (tests/reference/gyoto_gas.csv).  Its observer rests at r = 10,000.
TEST(GyotoGas, IsTheSame) {
  for (const std::string kind : {"halo", "slab"})
    for (const double inclination : {45.0, 80.0}) {
      GasCase view{{{Region::kI, Tetrad::kRain, 1e4, celerity_of_rest(1e4)},
                    normal_seen_from(90 - inclination),
                    slab(0.1)}};
      // So hot that light goes with the temperature.
      view.at.disc.t_max_k = 1e9;
      view.disc = kind == "slab";
      if (!view.disc) view.halo = Halo{.r = 6, .height = 0.3, .luminance = 1};
      const GasScene gas(gas_show(view, Stereographic{20, 20, 0.3 * kDegree}));
      const GasRays rays(gas.scene);
      std::vector<double> seen, truth;
      CsvFile rows(source_file("tests/reference/gyoto_gas.csv"));
      while (rows.next()) {
        if (rows.text("kind") != kind || rows.number("inclination_deg") != inclination) continue;
        const double right = rows.number("right"), up = rows.number("up");
        const V3d n(-std::sqrt(1 - right * right - up * up), -up, right);
        seen.push_back(luminance_of(
            gas.seen(rays, {apply_transposed(gas.state.observer.tetrad_from_camera, n)}).light));
        truth.push_back(rows.number("light"));
      }
      ASSERT_EQ(seen.size(), 400u);
      const double brightest = *std::max_element(seen.begin(), seen.end());
      std::vector<double> errors;
      for (std::size_t k = 0; k < seen.size(); ++k)
        errors.push_back(std::abs(seen[k] / brightest - truth[k]) / (truth[k] + 0.01));
      std::sort(errors.begin(), errors.end());
      EXPECT_LT(errors[errors.size() / 2], 3e-4) << kind << " " << inclination;
      EXPECT_LT(errors.back(), 2e-3) << kind << " " << inclination;
    }
}

// Pixels take the light of the rays in their middles, where it is smooth.
TEST(GasPass, IsTheLightOfItsPixelsRays) {
  const std::vector<GasCase> views = gas_views();
  for (std::size_t v = 0; v < views.size(); v += 2) {
    const int width = 480, height = 320;
    const GasScene gas(gas_show(views[v], Stereographic{width, height, 110 * kDegree}));
    const GasPass pass(gas.scene);
    FloatImage frame(width, height);
    std::vector<float> left(static_cast<std::size_t>(width) * height, 1);
    pass.draw_rows(0, height, frame.row(0), left.data());
    std::mt19937 random(9);
    double brightest = 0;
    struct Compared {
      double drawn, seen;
    };
    std::vector<Compared> compared;
    for (int k = 0; k < tries(600, 60); ++k) {
      const int column = static_cast<int>(random() % width),
                row = static_cast<int>(random() % height);
      const CameraDirection n = direction_at(gas.state.projection, {column + 1.0, row + 1.0});
      if (gas.scene.tracer.trace(n).to_edge < 0.03) continue;
      const GasSight seen = gas.seen(pass.rays(), n);
      const double light = luminance_of(seen.light) * gas.scene.exposure;
      compared.push_back({luminance(pixel_at(frame, column, row)), light});
      brightest = std::max(brightest, light);
      EXPECT_NEAR(left[static_cast<std::size_t>(row * width + column)], seen.left, 0.05)
          << v << " " << column << " " << row;
    }
    double off = 0;
    for (const Compared& c : compared) {
      EXPECT_NEAR(c.drawn, c.seen, 0.02 * brightest) << v;
      off += std::abs(c.drawn - c.seen);
    }
    EXPECT_LT(off / static_cast<double>(compared.size()), 1e-3 * brightest) << v;
  }
}

// Its light goes on without a jump while an observer passes through its plane.
TEST(GasPass, ShowsNoJumpWhereItsPlaneIsCrossed) {
  double before = 0;
  for (int k = -8; k <= 8; ++k) {
    const GasCase at{{{Region::kI, Tetrad::kRain, 14, celerity_of_rest(14)},
                      normal_seen_from(0.5 * k),
                      slab(0.08)}};
    const Show show = gas_show(at, Domemaster{tries(128, 48)});
    const double lux = illuminance(show, render_floats(show));
    if (k > -8) {
      EXPECT_NEAR(lux / before, 1, 0.1) << k;
    }
    before = lux;
  }
}

// A pattern has a mean of 1, and the same pixels come of any number of threads.
TEST(GasPass, ShowsPatternsWithTheSameLight) {
  GasCase at{
      {{Region::kI, Tetrad::kRain, 30, celerity_of_rest(30)}, normal_seen_from(40), slab(0.08)}};
  const auto lux = [&] {
    const Show show = gas_show(at, Domemaster{tries(256, 64)});
    const FloatImage frame = render_floats(show);
    EXPECT_EQ(frame.pixels, render_floats(show, 2).pixels);
    return illuminance(show, frame);
  };
  const double plain = lux();
  at.at.disc.patterns = {TurbulencePattern{}};
  EXPECT_NEAR(lux() / plain, 1, 0.15);
  at.at.disc.patterns = {SpotPattern{}};
  EXPECT_NEAR(lux() / plain, 1, 0.1);
}

}  // namespace
}  // namespace domefall
