#include "pipeline/light/lens_store.h"

#include <gtest/gtest.h>

namespace domefall {
namespace {

ObserverState observer_at(double r) {
  ObserverState observer;
  if (r != kFlatSpace) observer.spacetime = Schwarzschild{};
  observer.r = r;
  return observer;
}

TEST(LensStore, KeepsTablesWhileTheObserverStays) {
  LensStore store;
  store.lens(observer_at(10), {});
  EXPECT_EQ(store.tables_made(), 1);
  store.lens(observer_at(10), {{true, true, true}});
  EXPECT_EQ(store.tables_made(), 1);
  const std::size_t nodes = store.table_nodes();
  store.lens(observer_at(10), {});
  EXPECT_EQ(store.tables_made(), 0);
  EXPECT_EQ(store.table_nodes(), nodes);
  store.lens(observer_at(11), {});
  EXPECT_EQ(store.tables_made(), 1);
  store.lens(observer_at(kFlatSpace), {});
  EXPECT_EQ(store.tables_made(), 0);
  EXPECT_EQ(store.table_nodes(), 0u);
}

// Two lenses of one place are compared while both are there (shutter.cpp).
TEST(LensStore, GivesALensThatKnowsWhatWasAskedForWhateverOthersAskLater) {
  LensStore store;
  const auto dark = store.lens(observer_at(10), {{false, false, false}});
  const auto lit = store.lens(observer_at(10), {});
  const V3d outward(1, 0, 0);
  EXPECT_FALSE(dark->ray(outward).known);
  EXPECT_TRUE(lit->ray(outward).known);
}

// A camera is aimed at the image that is drawn.
TEST(LensStore, GivesLensesThatSeeAPointFirstWhereTheyAim) {
  for (const double r : {0.5, 3.0, 30.0, kFlatSpace}) {
    const auto lens = LensStore().lens(observer_at(r), {});
    for (const V3d& source : {V3d(0.6, 0.8, 0), V3d(-0.6, 0, -0.8), V3d(0, -0.6, 0.8)}) {
      const V3d drawn = lens->points(SkyRegion::kI, {})->image(source, 0, 1e-9).direction.v;
      EXPECT_LT((lens->primary_image(source) - drawn).length(), 1e-8) << r;
    }
  }
}

}  // namespace
}  // namespace domefall
