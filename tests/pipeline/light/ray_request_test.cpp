#include "pipeline/light/ray_request.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <string>

#include "pipeline/base/errors.h"

namespace domefall {
namespace {

TEST(RayRequest, DecimalsKeepTheDistancesThatADoubleLoses) {
  const Radius at = decimal_radius("2.000000000000001");
  EXPECT_EQ(at.above_horizon, 1e-15);
  EXPECT_NE(2.000000000000001 - 2, 1e-15);
  EXPECT_EQ(decimal_radius("3.0000000000000000000000001").above_light_circle, 1e-25);
  EXPECT_EQ(decimal_radius("7").above_horizon, 5);
}

TEST(RayRequest, NumbersOfAnyLengthAndExponentAreReadOrRefused) {
  EXPECT_EQ(decimal_radius("0." + std::string(5000, '3')).r, 1 / 3.0);
  for (const char* text : {"1e99999", "1e-4000", "-5", "0", "1e1000000000000", "-0"})
    EXPECT_THROW(ray_at_angle(TraceObserver::kRain, decimal_radius(text), 1), InputError) << text;
  for (const char* text : {"", "nan", "inf", "0x10", "1 2", "1,5", "six", "1e", "."})
    EXPECT_THROW(decimal_number(text, "r"), InputError) << text;
}

TEST(RayRequest, NaNIsNoRay) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ray_at_angle(TraceObserver::kRain, nan, 1), InputError);
  EXPECT_THROW(ray_at_angle(TraceObserver::kRain, 6, nan), InputError);
  EXPECT_THROW(ray_at_edge(TraceObserver::kRain, nan, "silhouette", 0), InputError);
  EXPECT_THROW(ray_at_edge(TraceObserver::kRain, 6, "silhouette", nan), InputError);
}

TEST(RayRequest, ObserversStayWhereTheyCanBe) {
  EXPECT_THROW(ray_at_angle(TraceObserver::kStatic, 2, 1), InputError);
  EXPECT_NO_THROW(
      ray_at_angle(TraceObserver::kStatic, decimal_radius("2.00000000000000000001"), 1));
  EXPECT_THROW(ray_at_angle(TraceObserver::kTwo, 2, 1), InputError);
  EXPECT_NO_THROW(ray_at_angle(TraceObserver::kFour, decimal_radius("1.99999999999999999999"), 1));
  EXPECT_THROW(ray_at_edge(TraceObserver::kFour, 1, "silhouette", 0), InputError);
}

TEST(RayRequest, PiRoundedUpIsPi) {
  EXPECT_EQ(ray_at_angle(TraceObserver::kRain, 6, decimal_number("3.1415926535898", "delta")).delta,
            std::numbers::pi_v<long double>);
  EXPECT_THROW(ray_at_angle(TraceObserver::kRain, 6, 3.1416), InputError);
}

TEST(RayRequest, NamesAreThoseOfTheCommandLine) {
  EXPECT_EQ(trace_observer("T_IV"), TraceObserver::kFour);
  EXPECT_EQ(trace_method("binet-rkf78"), TraceMethod::kBinetRkf78);
  EXPECT_THROW(trace_observer("Rain"), InputError);
  EXPECT_THROW(trace_method("table "), InputError);
}

}  // namespace
}  // namespace domefall
