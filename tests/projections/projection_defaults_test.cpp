#include "projections/projection_defaults.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "projections/projection.h"

namespace domefall {
namespace {

using std::numbers::pi;

// An equisolid fisheye, r = sin(theta/2), of which only what a projection must say is said.
struct Equisolid {
  static constexpr ProjectionTraits kTraits{.name = "equisolid",
                                            .has_zenith = true,
                                            .is_dome = true,
                                            .widest_deg = 360,
                                            .description = ""};
  int columns = 300, rows = 240;
  double fov = 4;
  double cut_back = 0.25;

  double scale() const { return 2 * std::sin(fov / 4) / columns; }
  double largest_pixel_angle() const { return 2 * scale() / std::cos(fov / 4); }
  CameraDirection direction(Centred at) const {
    const double r = std::hypot(at.x, at.y) * scale();
    const double k = 2 * std::sqrt(std::max(0.0, 1 - r * r)) * scale();
    return {{at.x * k, at.y * k, 1 - 2 * r * r}};
  }
  std::optional<Centred> place(const CameraDirection& n) const {
    return place_about_z(1 / (scale() * std::sqrt(2 * (1 + n.v.z))), n);
  }
};

// The sphere by longitude and the sine of latitude, of equal areas and with a seam.
struct Cylinder {
  static constexpr ProjectionTraits kTraits{
      .name = "cylinder", .has_zenith = true, .description = ""};
  int columns = 200, rows = 100;

  double largest_pixel_angle() const { return 1; }
  CameraDirection direction(Centred at) const {
    const double sine = std::clamp(-at.y / (rows / 2.0), -1.0, 1.0);
    const double across = std::sqrt(1 - sine * sine), longitude = at.x * 2 * pi / columns;
    return {{across * std::sin(longitude), across * std::cos(longitude), sine}};
  }
  std::optional<Centred> place(const CameraDirection& n) const {
    return Centred{std::atan2(n.v.x, n.v.y) * columns / (2 * pi), -n.v.z * rows / 2};
  }
};

std::mt19937& random_numbers() {
  static std::mt19937 random(1);
  return random;
}
double between(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random_numbers());
}

TEST(ProjectionDefaults, AnEquisolidFisheyeHasEqualAreas) {
  const Equisolid p;
  for (int k = 0; k < 100; ++k) {
    const Centred at{between(-100, 100), between(-100, 100)};
    EXPECT_NEAR(solid_angle_of(p, at) / (4 * p.scale() * p.scale()), 1, 1e-4);
    // A pixel covers 1/cos(theta/2) of 2 `scale` along the direction to the middle.
    const double r = std::hypot(at.x, at.y) * p.scale();
    EXPECT_NEAR(pixel_angle_of(p, at) / (2 * p.scale() / std::sqrt(1 - r * r)), 1, 1e-4);
    EXPECT_LE(pixel_angle_of(p, at), p.largest_pixel_angle());
  }
}

TEST(ProjectionDefaults, ADomeLowerThanWideIsCutAndShowsItsCircle) {
  const Equisolid p;
  // Of 60 rows a quarter is cut at the top.
  EXPECT_EQ(origin_of(p).j, 150.5 - 15);
  for (int row = 0; row < p.rows; ++row) {
    const ColumnRange range = inside_columns_of(p, row);
    for (int column = 0; column < p.columns; ++column)
      EXPECT_EQ(shows_at(p, centred(p, {column + 1.0, row + 1.0})),
                column >= range.first && column <= range.last);
  }
}

template <class P>
void expect_metric(const P& p) {
  for (int k = 0; k < 50; ++k) {
    const Centred at{between(-0.4, 0.4) * width_of(p), between(-0.4, 0.4) * height_of(p)};
    const PixelMetric m = metric_of(p, at), d = metric_by_differences(p, at);
    // The differences err by h^2/6 of the third derivative, and by rounding.
    const double error = 1e-6 * (m.xx + m.yy);
    EXPECT_NEAR(m.xx, d.xx, error) << P::kTraits.name;
    EXPECT_NEAR(m.xy, d.xy, error) << P::kTraits.name;
    EXPECT_NEAR(m.yy, d.yy, error) << P::kTraits.name;
  }
}

TEST(ProjectionDefaults, DifferencesAreTheMetric) {
  expect_metric(Domemaster{512});
  expect_metric(Fisheye{512, 400, 4, 1});
  expect_metric(Stereographic{512, 300, 2});
  expect_metric(Rectilinear{512, 300, 2});
  expect_metric(Equirectangular{512});
}

// Every pixel of a cap is in the box of its rim, and most boxes are not the whole image.
template <class P>
void expect_caps_in_boxes(const P& p) {
  int bounded = 0;
  for (int k = 0; k < 150; ++k) {
    const PixelPosition middle{between(0.5, width_of(p) + 0.5), between(0.5, height_of(p) + 0.5)};
    if (!shows_at(p, centred(p, middle))) continue;
    const CameraDirection n = p.direction(centred(p, middle));
    const double angle = between(0, 1) * between(0, 0.6);
    const CapBox box = cap_box_of_rim(p, n, angle);
    bounded += box.reach < kWholeImage ? 1 : 0;
    for (int row = 1; row <= height_of(p); ++row)
      for (int column = 1; column <= width_of(p); ++column) {
        const Centred at = centred(p, {double(column), double(row)});
        if (!shows_at(p, at) || (p.direction(at).v - n.v).length() > 2 * std::sin(angle / 2))
          continue;
        const double x = column - middle.i, y = row - middle.j;
        EXPECT_TRUE(x >= -box.left && x <= box.right && y >= -box.up && y <= box.down &&
                    std::hypot(x, y) <= box.reach)
            << P::kTraits.name << " " << middle.i << " " << middle.j << " " << angle;
      }
  }
  EXPECT_GT(bounded, 40) << P::kTraits.name;
}

TEST(ProjectionDefaults, TheBoxOfARimHoldsItsCap) {
  expect_caps_in_boxes(Equisolid{100, 80, 6, 0.25});
  expect_caps_in_boxes(Equisolid{100, 100, 2, 0});
  expect_caps_in_boxes(Cylinder{120, 60});
  expect_caps_in_boxes(Fisheye{100, 100, 2 * pi, 0});
  expect_caps_in_boxes(Equirectangular{128});
  expect_caps_in_boxes(Rectilinear{100, 60, 2});
  expect_caps_in_boxes(Stereographic{100, 60, 5});
}

// Every pixel of a cap is in its box and in the spans of its row.
TEST(ProjectionDefaults, CapsLieInTheirBoxesWhateverAPixelsShape) {
  std::mt19937 random(5);
  for (const Projection& p :
       {Projection(Stereographic{80, 90, 3, 2}), Projection(Rectilinear{80, 60, 2, 0.5}),
        Projection(Fisheye{60, 110, 5, 0.5, 2})}) {
    std::uniform_real_distribution<double> u(0.5, columns(p) + 0.5), v(0.5, rows(p) + 0.5),
        size(0.01, 0.5);
    for (int k = 0; k < 40; ++k) {
      const PixelPosition middle{u(random), v(random)};
      if (!is_inside(p, middle)) continue;
      const CameraDirection n = direction_at(p, middle);
      const double angle = size(random);
      const CapBox box = cap_box(p, n, angle).value();
      const CapPlace place{middle.i - 1, middle.j - 1, angle, box.reach, 0, columns(p) - 1};
      for (int row = 0; row < rows(p); ++row) {
        const ColumnRange inside = inside_columns(p, row);
        const CapSpans spans = spans_of(p, place, row, inside);
        for (int column = inside.first; column <= inside.last; ++column) {
          const CameraDirection at = direction_at(p, {column + 1.0, row + 1.0});
          if ((at.v - n.v).length() > 2 * std::sin(angle / 2)) continue;
          const double x = column + 1 - middle.i, y = row + 1 - middle.j;
          EXPECT_TRUE(x >= -box.left && x <= box.right && y >= -box.up && y <= box.down);
          EXPECT_TRUE(std::any_of(spans.span.begin(), spans.span.begin() + spans.count,
                                  [&](const ColumnRange& span) {
                                    return column >= span.first && column <= span.last;
                                  }));
        }
      }
    }
  }
}

}  // namespace
}  // namespace domefall
