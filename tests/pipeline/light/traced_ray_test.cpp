#include "pipeline/light/traced_ray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "tests/pipeline/light/reference_rays.h"

namespace domefall {
namespace {

TraceObserver observer_named(const std::string& name) {
  if (name == "static") return TraceObserver::kStatic;
  if (name == "outgoing") return TraceObserver::kOutgoing;
  if (name == "T_II") return TraceObserver::kTwo;
  return name == "T_IV" ? TraceObserver::kFour : TraceObserver::kRain;
}

RayRequest request_of(const ReferenceRay& row) {
  RayRequest q;
  q.observer = observer_named(row.observer);
  q.at = Radius(row.r_decimal);
  q.delta = row.delta_decimal;
  if (!row.edge.empty()) q.edge = row.edge == "silhouette" ? Edge::kSilhouette : Edge::kRegionThree;
  q.offset = row.offset;
  return q;
}

std::string place(const ReferenceRay& row) {
  return row.observer + " r=" + std::to_string(row.r) + " delta=" + std::to_string(row.delta) +
         " " + row.edge + " " + std::to_string(row.offset);
}

class ReferenceRows : public testing::TestWithParam<const char*> {};

TEST_P(ReferenceRows, HaveTheRightOrigin) {
  for (const ReferenceRay& row : reference_rays(GetParam()))
    EXPECT_EQ(name_of(trace_ray(request_of(row), TraceMethod::kExact).origin), row.origin)
        << place(row);
}

void expect_same_redshift(const TracedRay& ray, const ReferenceRay& row) {
  if (row.origin == "IV")
    EXPECT_TRUE(std::isnan(ray.one_plus_z)) << place(row);
  else
    EXPECT_NEAR(ray.one_plus_z, row.one_plus_z, 1e-13 * row.one_plus_z) << place(row);
}

TEST_P(ReferenceRows, ExactAzimuthIsRightToOneInTenToTheThirteen) {
  for (const ReferenceRay& row : reference_rays(GetParam())) {
    const TracedRay ray = trace_ray(request_of(row), TraceMethod::kExact);
    EXPECT_NEAR(ray.phi, row.phi, 1e-13 * std::max(1.0, row.phi)) << place(row);
    expect_same_redshift(ray, row);
    EXPECT_NEAR(ray.slope, row.slope, 1e-8 * std::abs(row.slope)) << place(row);
  }
}

TEST_P(ReferenceRows, TableAzimuthIsRightToOneInTenToTheTen) {
  for (const ReferenceRay& row : reference_rays(GetParam())) {
    const TracedRay ray = trace_ray(request_of(row), TraceMethod::kTable);
    EXPECT_NEAR(ray.phi, row.phi, 1e-10 * std::max(1.0, row.phi)) << place(row);
    expect_same_redshift(ray, row);
    EXPECT_NEAR(ray.slope, row.slope, 1e-7 * std::abs(row.slope)) << place(row);
    // |sin phi| loses what phi loses: the bound is relative to how near the axis the image is.
    const double axis = std::abs(std::sin(row.phi));
    EXPECT_NEAR(ray.amplification, row.amplification, (1e-7 + 1e-10 / axis) * row.amplification)
        << place(row);
  }
}

INSTANTIATE_TEST_SUITE_P(OfThe, ReferenceRows, testing::ValuesIn(kReferenceObservers),
                         [](const auto& row) { return std::string(row.param); });

// Where both sines vanish: at delta = pi, and at 0 for sky III.
TEST(TracedRay, IsTheSameByBothMethodsAtTheFarEndOfASky) {
  for (const auto& [r, delta] :
       {std::pair(10.0, std::numbers::pi), std::pair(10.0, 3.1415926), std::pair(10.0, 3.14159),
        std::pair(1.0, 0.0), std::pair(1.0, 1e-9)}) {
    RayRequest q;
    q.at = Radius(r);
    q.delta = delta;
    const TracedRay exact = trace_ray(q, TraceMethod::kExact),
                    table = trace_ray(q, TraceMethod::kTable);
    EXPECT_NEAR(exact.slope / table.slope, 1, 1e-7) << r << " " << delta;
    EXPECT_NEAR(exact.amplification / table.amplification, 1, 1e-5) << r << " " << delta;
    EXPECT_NEAR(exact.amplification * exact.slope * exact.slope, 1, 1e-5);
  }
}

}  // namespace
}  // namespace domefall
