#include "pipeline/render/scene/sky_store.h"

#include <gtest/gtest.h>

#include <memory>

#include "pipeline/base/errors.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

const std::string kHead = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";

// A show of four segments, each with a panorama of its own.
class SkyStores : public ShowFile {
 protected:
  SkyStores() {
    for (int k = 0; k < 4; ++k) {
      // Radiance, whose pixels are three mantissas and an exponent.
      std::string pixels;
      for (int n = 0; n < 8; ++n)
        for (const int byte : {60 + 40 * k, 50 + 10 * n, 40, 128})
          pixels += static_cast<char>(byte);
      images_[k] = write("p" + std::to_string(k) + ".hdr", kHead + pixels);
    }
  }

  FramePlan plan_of(int image) {
    shown_[image] = PanoramaSky{images_[image]};
    FramePlan plan;
    plan.sky[SkyRegion::kI] = {true, false, false, &shown_[image]};
    return plan;
  }

  static std::weak_ptr<const SkyMap> map_of(const PerSky<const Sky*>& skies) {
    return std::get<std::shared_ptr<const SkyMap>>(skies[SkyRegion::kI]->background);
  }

  Show show_;
  std::filesystem::path images_[4];
  SkyBackground shown_[4];
};

TEST_F(SkyStores, KeepsAllMapsThatFit) {
  SkyStore store(show_);
  const auto first = map_of(store.skies_of(plan_of(0)));
  for (int k = 1; k < 4; ++k) store.skies_of(plan_of(k));
  EXPECT_FALSE(first.expired());
}

// They were kept for ever: six panoramas of 8k took 6.8 GB.
TEST_F(SkyStores, DropsMapsThatTheLastTwoPlansDoNotShowWhereRoomIsShort) {
  SkyStore store(show_, {kLargestFace, kAllWhole, 1});
  const auto first = map_of(store.skies_of(plan_of(0)));
  const auto second = map_of(store.skies_of(plan_of(1)));
  EXPECT_FALSE(first.expired()) << "a dissolve needs both";
  const WorkingRgb before = first.lock()->sample(V3d(1, 0, 0), 0.1);
  const auto third = map_of(store.skies_of(plan_of(2)));
  EXPECT_TRUE(first.expired());
  EXPECT_FALSE(second.expired());
  for (int k = 0; k < 4; ++k) {
    store.skies_of(plan_of(1));
    store.skies_of(plan_of(2));
  }
  EXPECT_FALSE(second.expired() || third.expired()) << "made anew for each frame";
  const auto again = map_of(store.skies_of(plan_of(0)));
  ASSERT_FALSE(again.expired());
  const WorkingRgb after = again.lock()->sample(V3d(1, 0, 0), 0.1);
  EXPECT_EQ(before.r, after.r);
}

TEST_F(SkyStores, ReadsButDoesNotMakeWhatHasNoRoomBeforeTheFirstFrame) {
  SkyStore store(show_, {kLargestFace, kAllWhole, 1});
  store.load(plan_of(0));
  store.load(plan_of(1));
  std::filesystem::remove(images_[0]);
  std::filesystem::remove(images_[1]);
  EXPECT_NO_THROW(store.skies_of(plan_of(0))) << "it had room";
  EXPECT_ANY_THROW(store.skies_of(plan_of(1))) << "it had none";
  write("p2.hdr", kHead + "short");
  EXPECT_THROW(store.load(plan_of(2)), InputError);
}

// A star that stands for others would come and go with the light of all.
TEST_F(SkyStores, SharesStarsOnlyWhereTheLimitChangesForBothSkiesOrNeither) {
  for (const SkyRegion sky : kExteriorSkies)
    show_.sky[sky].stars = StarField{folder_ / "assets/stars_to_9.stars", 6};
  Segment& segment = show_.timeline.emplace_back();
  SkyDetail detail;
  detail.whole_stars = 1;
  const auto stars_of = [](SkyStore& store, SkyRegion sky) {
    return store.sky(sky, std::nullopt, true).stars;
  };
  SkyStore steady(show_, detail);
  const auto of_both = stars_of(steady, SkyRegion::kI);
  EXPECT_LT(of_both->size(), 3U);
  EXPECT_EQ(of_both, stars_of(steady, SkyRegion::kIII));

  segment.curves[max_magnitude_channel(SkyRegion::kIII)] = Curve{{{0, 6}}};
  SkyStore store(show_, detail);
  EXPECT_EQ(stars_of(store, SkyRegion::kI)->size(), of_both->size());
  EXPECT_EQ(stars_of(store, SkyRegion::kIII)->size(), 3U);
}

}  // namespace
}  // namespace domefall
