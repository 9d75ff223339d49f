// Gas about a hole that spins, against sums of many small steps along rays of Hamilton's equations in the
// coordinates of Kerr and Schild, with four-velocities from the metric in these.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "pipeline/render/disc/gas_rays.h"
#include "pipeline/report/reference/kerr_schild.h"
#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/disc/disc_light.h"
#include "tests/pipeline/render/disc/disc_views.h"
#include "tests/pipeline/show/show_file.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

double nits(const std::array<float, 3>& c) { return luminance(WorkingRgb{c[0], c[1], c[2]}); }

// What gas can do at a place of a ray: -k.u of whoever circles with dphi/dt, or flows out from the hole.
class PlaceOfGas {
 public:
  PlaceOfGas(const KerrSchild& hole, const KerrSchildState& s)
      : at(s[0], s[1], s[2]), r(hole.radius(s)), latitude_sine(s[2] / r), a_(hole.a) {
    const V3d p(s[3], s[4], s[5]), about(-at.y, at.x, 0);
    const double f = hole.strength(s, r), along = hole.null(s, r).dot(about);
    energy_ = hole.energy, momentum_ = p.dot(about);
    tt_ = f - 1, tp_ = f * along, pp_ = about.dot(about) + f * along * along;
    const double cosine2 = (1 - latitude_sine) * (1 + latitude_sine);
    sigma_ = r * r + a_ * a_ * latitude_sine * latitude_sine;
    // The derivative of the place by the polar angle, whose sine is that of all but the axis.
    const double sine = std::sqrt(cosine2), cotangent = latitude_sine / sine;
    polar_ = p.dot(V3d(at.x * cotangent, at.y * cotangent, -r * sine));
    KerrSchildState change;
    hole(s, change, 0);
    const double wide = r * r + a_ * a_;
    outward_ = -(at.x * change[0] + at.y * change[1] + at.z * change[2] * wide / (r * r)) > 0;
  }

  double turning_of_momentum(double l) const { return -(tp_ + l * tt_) / (pp_ + l * tp_); }
  double circling(double omega) const {
    return (energy_ - omega * momentum_) /
           std::sqrt(-(tt_ + 2 * omega * tp_ + omega * omega * pp_));
  }
  double flowing(double lorentz) const {
    const double here = circling(-tp_ / pp_);
    const double aside = polar_ * polar_ / sigma_ + momentum_ * momentum_ / pp_;
    const double out = std::sqrt(std::max(0.0, here * here - aside)) * (outward_ ? 1 : -1);
    return lorentz * here - std::sqrt(lorentz * lorentz - 1) * out;
  }

  V3d at;
  double r, latitude_sine;

 private:
  double a_, energy_, momentum_, tt_, tp_, pp_, sigma_, polar_;
  bool outward_;
};

class KerrGas : public ShowFile {
 protected:
  struct Summed {
    double nits = 0, left = 1;
  };

  Show gas_show(const std::string& spin, const std::string& gas, const std::string& trajectory) {
    return read(
        "size: [300, 200]\ncamera: {projection: stereographic, fov_deg: 100, look_at: hole}\n"
        "sky: {region_I: {background: black, stars: none}}\nblack_hole: {mass_solar: 4.3e6, " +
        spin + "}\n" + gas + "\ntimeline:\n  - {duration_s: 1, trajectory: {" + trajectory +
        "}}\n");
  }

  // Adds what a step of so much of the light's own measure sees.  k.u counts in the frequency seen.
  static void add(const Show& show, const DiscLight* disc_light, const KerrHole& kerr,
                  const PlaceOfGas& at, double step, double frequency, Summed& sum) {
    const double a = static_cast<double>(kerr.spin),
                 q2 = static_cast<double>(kerr.charge * kerr.charge);
    const double r = at.r, s = at.latitude_sine, delta = r * r - 2 * r + a * a + q2;
    const auto bright = [&](const GasTemperature& t, double sent) {
      return t ? blackbody_xyz(*t * frequency / sent).y / blackbody_xyz(*t).y
               : std::pow(frequency / sent, 3);
    };
    if (const auto& halo = show.halo) {
      const double rho = r * std::sqrt(1 - s * s);
      const double sent = at.circling(at.turning_of_momentum(std::pow(rho, 1.5) / (1 + rho)));
      const double n =
          delta / (r * r + a * a) *
          std::exp(-r * r / (2 * halo->r * halo->r) - s * s / (2 * halo->height * halo->height));
      sum.nits +=
          sum.left * n * sent * step * halo->luminance / halo->r * bright(halo->temperature, sent);
    }
    if (const auto& jet = show.jet) {
      const double sent = at.flowing(jet->lorentz), away = std::acos(std::abs(s));
      const double y = std::min(1.0, (r - static_cast<double>(kerr.horizon())) / jet->r);
      const double n = std::pow(jet->r / r, 2) * y * y * (3 - 2 * y) *
                       std::exp(-away * away / (2 * jet->opening * jet->opening) -
                                r * r / (2 * jet->length * jet->length));
      sum.nits +=
          sum.left * n * sent * step * jet->luminance / jet->r * bright(jet->temperature, sent);
    }
    const auto& disc = show.disc;
    if (!disc || r <= disc->inner || r >= disc->outer) return;
    const double w = std::sqrt(r - q2) * (disc->orbits.spin() * a < 0 ? -1 : 1);
    const double sent = at.circling(w / (r * r + a * w));
    const double height = disc->height * std::pow(r / disc->outer, 0.125);
    const auto thinned = [](double t) { return t < 1 ? t * t * t * (10 - 15 * t + 6 * t * t) : 1; };
    const double depth = disc->optical_depth * thinned((1 - r / disc->outer) / disc->rim) *
                         thinned((r / disc->inner - 1) / disc->rim);
    const double kept = std::exp(-depth / (std::sqrt(2 * std::numbers::pi) * height * r) *
                                 std::exp(-s * s / (2 * height * height)) * sent * step);
    sum.nits += sum.left * (1 - kept) * luminance(disc_light->light(r, frequency / sent));
    sum.left *= kept;
  }

  static Summed summed(const Show& show, const DiscLight* light, const KerrPlace& place,
                       double delta, double eta, double frequency) {
    const auto a = static_cast<double>(place.hole.spin), q = static_cast<double>(place.hole.charge);
    const auto from = static_cast<double>(place.r),
               horizon = static_cast<double>(place.hole.horizon());
    auto [hole, state] =
        kerr_schild_start(a, q, from, static_cast<double>(place.theta), delta, eta);
    boost::numeric::odeint::runge_kutta_fehlberg78<KerrSchildState> stepper;
    Summed sum;
    for (int k = 0; k < 20'000; ++k) {
      KerrSchildState change;
      hole(state, change, 0);
      const double r = hole.radius(state);
      if (r > 60 || (k > 100 && r < horizon * (1 + 1e-3) && from > horizon)) break;
      const double step = 1e-2 * r / V3d(change[0], change[1], change[2]).length();
      stepper.do_step(hole, state, 0, step / 2);
      if (const PlaceOfGas at(hole, state); at.r > horizon * (1 + 1e-6))
        add(show, light, place.hole, at, step, frequency, sum);
      stepper.do_step(hole, state, 0, step / 2);
    }
    return sum;
  }
};

// Beside the edge of the silhouette rays part by e for each radian, so those next to it are left out.
TEST_F(KerrGas, IsTheSumOfSmallSteps) {
  struct View {
    const char *spin, *gas, *trajectory;
  };
  constexpr const char
      *kHalo = "halo: {r: 5, luminance_cd_m2: 1}",
      *kJet = "jet: {r: 4, length_r: 9, lorentz_factor: 2, opening_deg: 9, luminance_cd_m2: 1}",
      *kWarm = "halo: {r: 5, t_k: 4000, luminance_cd_m2: 1}",
      *kSlab = "disc: {height: 0.1, optical_depth: 2, rim: 0.2}",
      *kBack = "disc: {height: 0.1, optical_depth: 2, rim: 0.2, retrograde: true}";
  constexpr const char* kAbove = "type: static, r: 15, latitude_deg: 30";
  std::mt19937 random(3);
  for (const View& view : std::vector<View>{
           {"spin: 0.9", kHalo, kAbove},
           {"spin: 0.9", kWarm, kAbove},
           {"spin: 0.9", kJet, kAbove},
           {"spin: 0.9", kSlab, kAbove},
           {"spin: 0.9", kBack, kAbove},
           {"spin: 0.998", kHalo, "type: circular, r: 4"},
           {"spin: 0.998", kJet, "type: infall, from_r: 3, latitude_deg: 70"},
           {"spin: 0.6, charge: 0.7", kHalo, "type: static, r: 6, latitude_deg: -50"},
           {"spin: 0.6, charge: 0.7", kSlab, "type: static, r: 12, latitude_deg: 12"}}) {
    SCOPED_TRACE(std::string(view.spin) + " " + view.gas + " " + view.trajectory);
    const Show show = gas_show(view.spin, view.gas, view.trajectory);
    const FrameState state = frame_state(show, 0);
    std::optional<DiscLight> light;
    if (show.disc) light.emplace(*show.disc);
    const FrameScene scene(show, state, plan_frame(show, state),
                           lens_of(state.observer, WantedSkies{}, show.effects), {}, {},
                           light ? &*light : nullptr);
    const GasRays rays(scene);
    const KerrPlace place = scene.tracer.lens()->gas_view()->spinning.value();
    std::vector<std::pair<double, double>> compared;
    double brightest = 0;
    for (int k = 0; k < tries(40, 6); ++k) {
      const PixelPosition pixel{1.0 + static_cast<double>(random() % 300),
                                1.0 + static_cast<double>(random() % 200)};
      const CameraDirection n = direction_at(state.projection, pixel);
      if (std::abs(scene.tracer.trace(n).to_edge) < 3e-3) continue;
      const GasSight seen = rays.sight_before(n, HUGE_VAL);
      FrameRayBatch at;
      scene.tracer.into_frame(&n, 1, at);
      const Summed truth =
          summed(show, light ? &*light : nullptr, place, std::acos(std::clamp(-at.x[0], -1.0, 1.0)),
                 std::atan2(-at.z[0], -at.y[0]), at.frequency[0]);
      compared.emplace_back(nits(seen.light), truth.nits);
      brightest = std::max(brightest, truth.nits);
      EXPECT_NEAR(seen.left, truth.left, 3e-3) << pixel.i << " " << pixel.j;
    }
    EXPECT_GT(brightest, 0);
    for (const auto& [seen, truth] : compared)
      EXPECT_NEAR(seen, truth, 3e-3 * (truth + 0.01 * brightest));
  }
}

}  // namespace
}  // namespace domefall
