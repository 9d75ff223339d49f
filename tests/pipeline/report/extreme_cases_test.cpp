#include "pipeline/report/extreme_cases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

namespace domefall {

void PrintTo(const ExtremeCase& c, std::ostream* out) { *out << c.tried; }

namespace {

class ExtremeCases : public testing::TestWithParam<ExtremeCase> {};

// Every case on the list of docs/accuracy.md keeps the bound that is stated there.
TEST_P(ExtremeCases, StaysWithinItsBound) {
  const ExtremeResult result = GetParam().measure();
  EXPECT_TRUE(std::isfinite(result.worst));
  EXPECT_LE(result.worst, GetParam().bound) << GetParam().quantity << "\n" << result.outcome;
}

std::string case_name(const testing::TestParamInfo<ExtremeCase>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Rays, ExtremeCases, testing::ValuesIn(extreme_rays()), case_name);
INSTANTIATE_TEST_SUITE_P(Swept, ExtremeCases, testing::ValuesIn(extreme_swept()), case_name);
INSTANTIATE_TEST_SUITE_P(Spins, ExtremeCases, testing::ValuesIn(extreme_spins()), case_name);
INSTANTIATE_TEST_SUITE_P(Frames, ExtremeCases, testing::ValuesIn(extreme_frames()), case_name);

}  // namespace
}  // namespace domefall
