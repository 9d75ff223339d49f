#include "pipeline/report/reference/reference_ray.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/source_tree.h"

namespace domefall {
namespace {

struct Row {
  std::string text;
  ReferenceRequest request;
  std::string origin;
  Wide phi, slope, amplification;
  std::string one_plus_z;  // empty for rays from the past singularity
};

ReferenceObserver observer_of(const std::string& name) {
  if (name == "static") return ReferenceObserver::kStatic;
  if (name == "outgoing") return ReferenceObserver::kOutgoing;
  if (name == "T_II") return ReferenceObserver::kTwo;
  if (name == "T_IV") return ReferenceObserver::kFour;
  EXPECT_EQ(name, "rain");
  return ReferenceObserver::kRain;
}

Row row_of(const std::string& line) {
  std::vector<std::string> cell;
  std::istringstream cells(line);
  for (std::string c; std::getline(cells, c, ',');) cell.push_back(c);
  if (cell.back().ends_with('\r')) cell.back().pop_back();
  cell.resize(10);
  Row row{line, {}, cell[5], Wide(cell[6]), Wide(cell[8]), Wide(cell[9]), cell[7]};
  row.request.observer = observer_of(cell[0]);
  row.request.r = Wide(cell[1]);
  if (cell[3].empty()) {
    row.request.delta = Wide(cell[2]);
  } else {
    row.request.edge =
        cell[3] == "silhouette" ? ReferenceEdge::kSilhouette : ReferenceEdge::kRegionThree;
    row.request.offset = Wide(cell[4]);
  }
  return row;
}

std::vector<Row> reference_rows() {
  std::ifstream in(source_file("tests/reference/rays.csv"));
  std::vector<Row> found;
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && line[0] != '#' && line.rfind("observer", 0) != 0)
      found.push_back(row_of(line));
  return found;
}

const char* origin_name(ReferenceOrigin origin) {
  return std::array{"I", "III", "IV"}.at(static_cast<std::size_t>(origin));
}

double relative(const Wide& value, const Wide& truth) {
  return static_cast<double>(abs(value - truth) / abs(truth));
}

// The bound is half a unit in the last place of a double and the table's own rounding.
constexpr double kPhi = 1e-15;

TEST(ReferenceRay, AgreesWithTheTable) {
  const std::vector<Row> all = reference_rows();
  ASSERT_GT(all.size(), 700U);
  for (const Row& row : all) {
    SCOPED_TRACE(row.text);
    const ReferenceRay ray = reference_ray(row.request);
    EXPECT_EQ(origin_name(ray.origin), row.origin);
    if (!row.one_plus_z.empty()) {
      EXPECT_LT(relative(ray.one_plus_z, Wide(row.one_plus_z)), kPhi);
    }
    EXPECT_LT(relative(ray.phi, row.phi), kPhi);
    EXPECT_LT(relative(ray.slope, row.slope), 1e-9);
    EXPECT_LT(relative(ray.amplification, row.amplification), 1e-9);
  }
}

// An observer at r = 3 is on the light circle, x = w - 1/3 = 0.  The azimuth is the integral of
// dx/sqrt(2 x^3 + x^2 + eps) from x = -1/3 or from infinity.  With |x| = sqrt(eps) sinh(t) the
// integrand is so smooth that a plain quadrature will do.
Wide quadrature_at_the_light_circle(const ReferenceRay& ray, ReferenceObserver observer) {
  const Wide s = sqrt(Wide(2) / 3), third = Wide(1) / 3;
  const bool is_static = observer == ReferenceObserver::kStatic;
  const Wide energy = is_static ? sqrt(third) : Wide(1 - s * cos(ray.delta));
  const Wide ratio = energy / (3 * sin(ray.delta)), eps = ratio * ratio - third * third * third;
  const Wide scale = sqrt(eps);
  const bool from_sky = ray.origin == ReferenceOrigin::kSkyOne;
  boost::math::quadrature::tanh_sinh<Wide> rule;
  const Wide inner = rule.integrate(
      [&](const Wide& t) -> Wide {
        const Wide x = (from_sky ? -scale : scale) * sinh(t);
        return scale * cosh(t) / sqrt((2 * x + 1) * x * x + eps);
      },
      Wide(0), Wide(asinh(third / scale)), Wide("1e-12"));
  if (from_sky) return inner;
  // The part beyond x = 1/3 is taken over v with x = 1/v^2.
  const Wide outer = rule.integrate(
      [&](const Wide& v) -> Wide {
        const Wide v2 = v * v;
        return 2 / sqrt(2 + v2 + eps * v2 * v2 * v2);
      },
      Wide(0), Wide(sqrt(Wide(3))), Wide("1e-12"));
  return inner + outer;
}

bool is_by_the_light_circle(const Row& row) {
  return row.request.edge && row.request.r == 3 && abs(row.request.offset) < Wide("1e-5");
}

TEST(ReferenceRay, BesideTheEdgeAtTheLightCircleAgreesWithQuadrature) {
  int checked = 0;
  for (const Row& row : reference_rows()) {
    if (!is_by_the_light_circle(row)) continue;
    SCOPED_TRACE(row.text);
    const ReferenceRay ray = reference_ray(row.request);
    EXPECT_LT(relative(ray.phi, quadrature_at_the_light_circle(ray, row.request.observer)), 1e-18);
    ++checked;
  }
  EXPECT_GE(checked, 12);
}

Wide sharp_pi() { return 4 * atan(Wide(1)); }

TEST(ReferenceRay, WithoutKillingEnergyRegionFourSeesTheArcsine) {
  for (const char* r : {"1e-6", "0.2", "1", "1.7", "1.998"}) {
    const Wide u(r);
    const ReferenceRay ray =
        reference_ray({ReferenceObserver::kFour, u, sharp_pi() / 2, std::nullopt, 0});
    EXPECT_EQ(ray.origin, ReferenceOrigin::kPastSingularity);
    // acos stands for an asin that would cancel for small r.
    EXPECT_LT(relative(ray.phi, acos(1 - u)), 1e-40) << r;
  }
}

TEST(ReferenceRay, WithoutKillingEnergyRegionTwoSeesTheRestOfTheTurn) {
  for (const char* r : {"1e-6", "0.2", "1", "1.998"}) {
    const Wide u(r);
    const ReferenceRay ray =
        reference_ray({ReferenceObserver::kTwo, u, sharp_pi() / 2, std::nullopt, 0});
    EXPECT_LT(relative(ray.phi, 2 * sharp_pi() - acos(1 - u)), 1e-40) << r;
  }
}

TEST(ReferenceRay, InFlatSpaceLightGoesStraight) {
  const ReferenceRay ray =
      reference_ray({ReferenceObserver::kStatic, Wide("1e12"), Wide(2), std::nullopt, 0});
  // The bending is of the order of 1/r.
  EXPECT_LT(relative(ray.phi, sharp_pi() - 2), 1e-11);
  EXPECT_LT(relative(ray.slope, -1), 1e-11);
}

TEST(ReferenceRay, ARadialRayIsNotBentAndStillHasASlope) {
  const ReferenceRay ray =
      reference_ray({ReferenceObserver::kStatic, Wide("1e12"), sharp_pi(), std::nullopt, 0});
  EXPECT_LT(abs(ray.phi), Wide("1e-90"));
  EXPECT_LT(relative(ray.amplification, 1), 1e-11);
}

TEST(ReferenceRay, AtTheHorizonCosDeltaIs23Over31) {
  const Wide edge = reference_edge(ReferenceObserver::kRain, 2, ReferenceEdge::kSilhouette);
  EXPECT_LT(relative(cos(edge), Wide(23) / 31), 1e-90);
}

TEST(ReferenceRay, SaysWhichObserversThereAre) {
  const auto at = [](ReferenceObserver o, double r) {
    return reference_ray({o, Wide(r), Wide(1), std::nullopt, 0});
  };
  EXPECT_THROW(at(ReferenceObserver::kStatic, 2), std::domain_error);
  EXPECT_THROW(at(ReferenceObserver::kTwo, 2.5), std::domain_error);
  EXPECT_THROW(at(ReferenceObserver::kFour, 2), std::domain_error);
  EXPECT_THROW(reference_edge(ReferenceObserver::kRain, 5, ReferenceEdge::kRegionThree),
               std::domain_error);
}

}  // namespace
}  // namespace domefall
