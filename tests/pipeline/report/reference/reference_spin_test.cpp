#include "pipeline/report/reference/reference_spin.h"

#include <gtest/gtest.h>

#include "tests/pipeline/light/kerr_rays.h"

namespace domefall {
namespace {

SpinView view_of(const KerrReference& row) {
  const auto number = [&](const char* column) { return Real50(row.text(column)); };
  SpinView view{number("spin"), number("charge"), number("r"), number("theta"), 0, number("eta")};
  if (!row.has("offset")) {
    view.delta = number("delta");
    return view;
  }
  const KerrEdge edge =
      row.text("edge") == "silhouette" ? KerrEdge::kSilhouette : KerrEdge::kRegionThree;
  const CriticalRay near = critical_ray(row.at(), row.exact("eta"), edge);
  view.delta = near.delta;
  view.delta = spin_edge(view, near.x);
  EXPECT_LT(abs(view.delta - near.delta), 1e-17);
  view.delta += number("offset");
  return view;
}

// Each fifth row, since a ray takes 20 ms.
TEST(ReferenceSpin, IsThatOfTheReferenceFile) {
  const std::vector<KerrReference> rows = kerr_references("kerr_rays.csv");
  ASSERT_GT(rows.size(), 400U);
  for (std::size_t i = 0; i < rows.size(); i += 5) {
    const KerrReference& row = rows[i];
    SCOPED_TRACE(row.line);
    const SpinTruth truth = reference_spin_ray(view_of(row));
    const std::string origin = truth.sky == ReferenceSky::kOwn     ? "I"
                               : truth.sky == ReferenceSky::kOther ? "III"
                                                                   : "H";
    ASSERT_EQ(origin, row.text("origin"));
    if (origin == "H") continue;
    const std::array<std::string, 3> axes{"x", "y", "z"};
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT(abs(truth.place[k] - Real50(row.text(axes[k]))), 2e-20);
  }
}

}  // namespace
}  // namespace domefall
