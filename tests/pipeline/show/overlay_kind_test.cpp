#include "pipeline/show/overlay_kind.h"

#include <gmock/gmock.h>

#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

TEST(Overlays, AreAListInTheOrderOfDrawing) {
  const auto some = parse_overlays("burn_in,rim,grid,rim");
  EXPECT_EQ(some, (std::vector{OverlayKind::kGrid, OverlayKind::kRim, OverlayKind::kBurnIn}));
  EXPECT_EQ(overlay_names(some), "grid,rim,burn_in");
  std::string all;
  for (const auto& [kind, name] : kOverlays) all.append(all.empty() ? "" : ",").append(name);
  EXPECT_EQ(overlay_names(parse_overlays(all)), all);
}

TEST(Overlays, OfOtherNamesAreRefused) {
  for (const auto& refused : {std::pair{"einstien_ring", "did you mean einstein_ring?"},
                              {"rim,,grid", "got ''"},
                              {"", "got ''"},
                              {"rim,", "got ''"},
                              {"rim grid", "got 'rim grid'"}})
    EXPECT_THAT(message_of([&] { parse_overlays(refused.first); }),
                testing::HasSubstr(refused.second));
}

}  // namespace
}  // namespace domefall
