// The shows of shows/charge/ against the numbers of docs/charges.md.  These are computed here from
// the metric, by quadrature and by its extrema, which shares nothing with the lens.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/show/file/read_show.h"
#include "tests/source_tree.h"
#include "trajectories/degree.h"

namespace domefall {
namespace {

using std::numbers::pi;

struct FigureOfCharge {
  const char* show;
  int frame;
  double charge, r;
  double light_circle, last_stable, impact;
  std::vector<double> edges;  // degrees from the middle of the hole
  double ring;                // likewise; 0: the page tells none
};

const std::vector<FigureOfCharge>& figures_of_charges() {
  static const std::vector<FigureOfCharge> figures{
      {"charge_0", 0, 0, 10, 3, 6, 5.19615, {27.69456}, 44.87456},
      {"charge_09", 0, 0.9, 10, 2.29373, 4.51375, 4.31923, {22.84716}, 42.63754},
      {"charge_1", 0, 1, 10, 2, 4, 4, {21.10020}, 42.07751},
      {"next", 1, 0.9, 10, 2.29373, 4.51375, 4.31923, {22.84716}, 42.63754},
      {"naked", 0, 1.05, 10, 1.71213, 3.64220, 3.75440, {19.76175}, 41.76886},
      {"inside", 0, 0.99, 0.82, 2.03833, 4.06081, 4.03886, {3.02689, 20.13691}, 0}};
  return figures;
}

double lapse_of_charge(double q, double r) { return 1 - 2 / r + q * q / (r * r); }

// The energy of a free circle at r.
double circling_energy(double q, double r) {
  const double f = lapse_of_charge(q, r), half_slope = 1 / (r * r) - q * q / (r * r * r);
  return f / std::sqrt(f - r * half_slope);
}

// The azimuth that light sweeps from infinity to r past its turn beyond r_c, with w = 1/r.
double swept_near_charge(double q, double b, double light_circle, double r) {
  const auto p = [=](double w) { return 1 / (b * b) + w * w * (-1 + w * (2 - q * q * w)); };
  double below = 0, above = 1 / light_circle;
  for (int k = 0; k < 100; ++k) {
    const double middle = (below + above) / 2;
    (p(middle) > 0 ? below : above) = middle;
  }
  const double turn = below;
  const auto rate = [=](double root) {  // w = turn - root^2, and P without that factor
    const double w = turn - root * root, squares = w * w + turn * turn;
    return 2 / std::sqrt((w + turn) + q * q * squares * (w + turn) - 2 * (squares + w * turn));
  };
  const auto leg = [&](double w) {
    return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
        rate, 0.0, std::sqrt(turn - w), 10, 1e-12);
  };
  return leg(0) + leg(1 / r);
}

class ChargeFigures : public testing::TestWithParam<FigureOfCharge> {
 protected:
  ChargeFigures()
      : show(read_show(source_file("shows/charge/") + GetParam().show + ".yaml")),
        state(frame_state(show, GetParam().frame)),
        tracer(state, WantedSkies{}),
        to_hole(apply_transposed(state.observer.tetrad_from_camera, {-1, 0, 0})),
        aside(apply_transposed(state.observer.tetrad_from_camera, {0, 0, 1})) {}

  // The ray that is seen at an angle from the middle of the hole.
  ViewRay seen_at(double degrees) const {
    const double angle = degrees * kDegree;
    return tracer.trace(CameraDirection{to_hole * std::cos(angle) + aside * std::sin(angle)});
  }

  Show show;
  FrameState state;
  ViewTracer tracer;
  V3d to_hole, aside;  // in the camera's axes
};

TEST_P(ChargeFigures, HaveTheirChargesAndTheirPlaces) {
  const auto* hole = std::get_if<ChargedHole>(&state.observer.spacetime.kind());
  EXPECT_EQ(hole ? hole->charge : 0, GetParam().charge);
  EXPECT_NEAR(state.observer.r, GetParam().r, 1e-11);
  const bool inside = GetParam().r < 1;
  EXPECT_EQ(state.observer.region, inside ? Region::kV : Region::kI);
  EXPECT_EQ(state.observer.universe, GetParam().frame);  // frame 1 is that of `next`
}

TEST_P(ChargeFigures, HaveTheirCirclesWhereTheMetricHasThem) {
  const FigureOfCharge& figure = GetParam();
  const double q = figure.charge, circle = figure.light_circle, last = figure.last_stable;
  const ChargedHole hole{1, q};
  EXPECT_NEAR(hole.light_circle(), circle, 1e-5);
  EXPECT_NEAR(hole.critical_impact(), figure.impact, 1e-5);
  EXPECT_NEAR(hole.last_stable_orbit(), last, 1e-5);
  // Light circles where f/r^2 is largest, and the last stable orbit has the least energy.
  EXPECT_NEAR(circle * circle - 3 * circle + 2 * q * q, 0, 3e-5);
  EXPECT_NEAR(circle / std::sqrt(lapse_of_charge(q, circle)), figure.impact, 1e-5);
  const auto slope = [q](double r) {
    return circling_energy(q, r + 1e-3) - circling_energy(q, r - 1e-3);
  };
  EXPECT_LT(slope(last - 3e-5), 0);
  EXPECT_GT(slope(last + 3e-5), 0);
}

TEST_P(ChargeFigures, HaveTheirEdgesWhereTheMetricHasThem) {
  const FigureOfCharge& figure = GetParam();
  const double f = lapse_of_charge(figure.charge, figure.r);
  const double resting = std::asin(figure.impact * std::sqrt(f) / figure.r);
  if (figure.edges.size() == 1) {
    EXPECT_NEAR(resting / kDegree, figure.edges[0], 1e-4);
    return;
  }
  // Who falls from rest far away moves at sqrt(1 - f) against who rests.
  const double speed = std::sqrt(1 - f), shrunk = std::sqrt((1 - speed) / (1 + speed));
  const double near = 2 * std::atan(shrunk * std::tan(resting / 2));
  const double far = 2 * std::atan(shrunk / std::tan(resting / 2));
  EXPECT_NEAR(near / kDegree, figure.edges[0], 1e-4);
  EXPECT_NEAR(far / kDegree, figure.edges[1], 1e-4);
}

// A ray beside an edge, on its inner and its outer side.
TEST_P(ChargeFigures, ShowOnBothSidesOfTheirEdgesWhatThePageSays) {
  const FigureOfCharge& figure = GetParam();
  const std::string name = figure.show;
  const double off = name == "naked" ? 1e-3 : 2e-5, edge = figure.edges.back();
  const ViewRay within = seen_at(edge - off), beyond = seen_at(edge + off);
  EXPECT_TRUE(beyond.known);
  EXPECT_EQ(beyond.sky, own_sky(state.observer));
  EXPECT_EQ(within.known, name == "next" || name == "naked");
  if (within.known) {
    EXPECT_EQ(within.sky, SkyRegion::kI);
  }
  if (name == "naked") {
    EXPECT_GT(within.swept, 2 * pi);
    EXPECT_GT(beyond.swept, 2 * pi);
  }
  if (name != "inside") return;
  EXPECT_TRUE(seen_at(figure.edges[0] - off).known);
  EXPECT_EQ(seen_at(figure.edges[0] - off).sky, SkyRegion::kI);
  EXPECT_FALSE(seen_at(figure.edges[0] + off).known);
}

TEST_P(ChargeFigures, HaveTheirEinsteinRingWhereTheMetricHasIt) {
  const FigureOfCharge& figure = GetParam();
  if (figure.ring == 0) return;
  double nearest = HUGE_VAL;
  for (const ViewCurve& curve : tracer.einstein_rings()) {
    const auto& circle = std::get<ViewCircle>(curve);
    const double angle = std::acos(circle.cosine * circle.axis.dot(to_hole)) / kDegree;
    nearest = std::min(nearest, std::abs(angle - figure.ring));
  }
  EXPECT_LT(nearest, 2e-5);
  const double f = lapse_of_charge(figure.charge, figure.r);
  const double b = figure.r * std::sin(figure.ring * kDegree) / std::sqrt(f);
  EXPECT_NEAR(swept_near_charge(figure.charge, b, figure.light_circle, figure.r), pi, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(OfThePage, ChargeFigures, testing::ValuesIn(figures_of_charges()),
                         [](const auto& figure) { return std::string(figure.param.show); });

}  // namespace
}  // namespace domefall
