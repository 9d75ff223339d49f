// Shows that lead through a charged hole into the next universe.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "pipeline/light/aberration.h"
#include "pipeline/show/attitude.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using enum Region;

class ChargedPassages : public ShowFile {
 protected:
  static constexpr double kCharge = 0.9;
  static inline const ChargedHole kChargedHole{1, 0.9L};

  Show show(const std::string& segments, const std::string& more = "") {
    return read("black_hole: {mass_solar: 4e6, charge: 0.9}\n" + more + "timeline:\n" + segments);
  }
  static ObserverState at(const Show& s, double t) {
    const int k = segment_at(s, t);
    return observer_at(s, k, part_at(s, k, t));
  }
  // The proper time from the turn of a fall from rest at infinity, r >= q^2/2.
  static double rain_time(double r) {
    const double q2 = kCharge * kCharge;
    return (r + q2) * std::sqrt(2 * r - q2) / 3;
  }
};

TEST_F(ChargedPassages, AFallGoesThroughEveryRegionIntoTheNextUniverse) {
  const Show s = show(
      "  - {duration_s: 100, trajectory: {type: infall, from_r: 12, to_r: 12, to_leg: outward}}\n");
  std::vector<std::string> regions;
  double r = 12;
  for (int k = 0; k <= 10000; ++k) {
    const ObserverState o = at(s, k / 100.0);
    const std::string name = region_name(o.region, o.universe);
    if (regions.empty() || regions.back() != name) regions.push_back(name);
    EXPECT_TRUE(k == 5000 || is_outgoing(o.tetrad) == (k > 5000)) << k;
    EXPECT_TRUE(has_tetrad(o.region, o.tetrad));
    EXPECT_TRUE(k == 0 || (k > 5000) == (o.r > r)) << k;
    r = o.r;
  }
  EXPECT_THAT(regions, testing::ElementsAre("I", "II", "V", "IV+1", "I+1"));
  EXPECT_EQ(own_sky(at(s, 100)), SkyRegion::kNext);
}

TEST_F(ChargedPassages, EveryEndIsWhereItsFormulaSays) {
  const double outer = kChargedHole.horizon(), inner = kChargedHole.inner_horizon();
  const double ends[] = {1, 0.6, inner, 0.5, 0.41};
  double before = 0;
  for (const double end : ends) {
    const Show s = show(fmt::format(
        "  - {{duration_s: 1, trajectory: {{type: infall, from_r: 12, to_r: {:.17g}}}}}\n", end));
    const ObserverState o = at(s, 1);
    EXPECT_NEAR(o.r, end, 1e-12 * end);
    EXPECT_NEAR(o.proper_time, rain_time(12) - rain_time(end), 1e-12 * rain_time(12));
    EXPECT_GT(o.proper_time, before);
    EXPECT_EQ(o.universe, 0);
    // Energy and angular momentum are those of the fall, in either tetrad.
    const StaticTime t = o.spacetime.static_time(o.r);
    EXPECT_NEAR(t.along_t * gamma_of(o.celerity) - t.along_r * o.celerity.x, 1, 1e-11);
    before = o.proper_time;
  }
  for (const double end : {0.41, 0.5, inner, 1.0, outer, 12.0, 1e3}) {
    const Show s = show(
        fmt::format("  - {{duration_s: 1, trajectory: {{type: infall, from_r: 12, to_r: {:.17g}, "
                    "to_leg: outward}}}}\n",
                    end));
    const ObserverState o = at(s, 1);
    EXPECT_NEAR(o.r, end, 1e-12 * end);
    EXPECT_NEAR(o.proper_time, rain_time(12) + rain_time(end),
                1e-12 * rain_time(std::max(12.0, end)));
    EXPECT_TRUE(end == inner || o.universe == (end > inner ? 1 : 0)) << end;
    const StaticTime t = o.spacetime.static_time(o.r);
    EXPECT_NEAR(t.along_t * gamma_of(o.celerity) + t.along_r * o.celerity.x, 1, 1e-11);
  }
}

// From rest at A it rests again after the period 2 pi A^(3/2), one universe on.
TEST_F(ChargedPassages, AFallFromRestGoesOnFromUniverseToUniverse) {
  const double excess = -(2 / 10.0 - kCharge * kCharge / 100), a = -1 / excess;
  const double period = 2 * std::numbers::pi * std::pow(a, 1.5);
  const Show s = show(fmt::format(
      "  - {{duration_s: 3, trajectory: {{type: infall, rest_r: 10, rate_m_per_s: {:.17g}}}}}\n",
      period));
  for (const int n : {0, 1, 2, 3}) {
    const ObserverState o = at(s, n);
    EXPECT_NEAR(o.r, 10, 1e-11) << n;
    if (n == 0 || n == 3) continue;  // the ends are those of a period, to rounding
    EXPECT_NEAR(at(s, n - 0.001).universe, n, 0) << n;
    EXPECT_NEAR(at(s, n + 0.001).universe, n, 0) << n;
    EXPECT_EQ(at(s, n + 0.001).region, kI);
  }
  EXPECT_EQ(own_sky(at(s, 1.9)), SkyRegion::kI);
  EXPECT_EQ(own_sky(at(s, 0.9)), SkyRegion::kNext);
}

// The states of a way in one piece are those of the same way cut where it crosses a horizon or turns.
TEST_F(ChargedPassages, SegmentsGoOnThroughEveryCrossing) {
  const std::string fall = "type: infall, from_r: 12, angular_momentum: 1.5";
  const Show whole =
      show("  - {duration_s: 1, trajectory: {" + fall + ", to_r: 12, to_leg: outward}}\n");
  const std::string periastron = fmt::format("to_tau_m: {:.17g}", at(whole, 1).proper_time / 2);
  const std::string ends[] = {"to_r: 1.435889894354067", "to_r: 0.564110105645933", periastron,
                              "to_r: 0.564110105645933", "to_r: 1.435889894354067", "to_r: 12"};
  std::string cut;
  for (std::size_t k = 0; k < std::size(ends); ++k)
    cut += fmt::format("  - {{duration_s: 1, trajectory: {{{}, {}{}}}}}\n",
                       k == 0 ? fall : "type: continue", ends[k],
                       k == 2  ? ""
                       : k < 2 ? ", to_leg: inward"
                               : ", to_leg: outward");
  const Show pieces = show(cut);
  const int last = static_cast<int>(std::size(ends)) - 1;
  const ObserverState a = at(whole, 1), b = observer_at(pieces, last, 1);
  EXPECT_EQ(b.universe, 1);
  EXPECT_NEAR(a.r, b.r, 1e-11);
  EXPECT_NEAR(a.proper_time, b.proper_time, 1e-11);
  EXPECT_NEAR(a.null_time, b.null_time, 1e-10);
  expect_near(a.celerity, b.celerity, 1e-11);
  expect_near(column(a.sky_from_tetrad, 0), column(b.sky_from_tetrad, 0), 1e-11);
  for (int k = 1; k <= last; ++k) {
    const ObserverState end = observer_at(pieces, k - 1, 1), begin = observer_at(pieces, k, 0);
    EXPECT_EQ(end.universe, begin.universe) << k;
    EXPECT_EQ(end.region, begin.region) << k;
    EXPECT_NEAR(end.null_time, begin.null_time, 1e-11) << k;
    expect_near(column(end.sky_from_tetrad, 2), column(begin.sky_from_tetrad, 2));
  }
}

// An orbit of its own begins in V or IV; the universe is that in which the one before has ended.
TEST_F(ChargedPassages, AnotherOrbitGoesOnInTheUniverseThatWasReached) {
  const Show s = show(
      "  - {duration_s: 1, trajectory: {type: infall, from_r: 12, to_r: 0.5, to_leg: outward}}\n"
      "  - {duration_s: 1, trajectory: {type: infall, rest_r: 3, from_r: 0.6, from_leg: outward, "
      "to_r: 2}}\n"
      "  - {duration_s: 1, trajectory: {type: static, r: 3}}\n"
      "  - {duration_s: 1, trajectory: {type: infall, rest_r: 3, to_r: 3, to_leg: outward}}\n");
  EXPECT_EQ(at(s, 0.999).region, kV);
  EXPECT_EQ(region_name(at(s, 1.001).region, at(s, 1.001).universe), "IV+1");
  EXPECT_EQ(region_name(at(s, 1.999).region, at(s, 1.999).universe), "I+1");
  EXPECT_EQ(at(s, 2.5).universe, 1);
  EXPECT_EQ(at(s, 3.999).universe, 2);
}

TEST_F(ChargedPassages, FromRegionThreeItGoesThroughTheMirrorImage) {
  const Show s = show(
      "  - {duration_s: 10, trajectory: {type: infall, region: III, from_r: 12, to_r: 12, to_leg: "
      "outward}}\n");
  std::vector<std::string> regions;
  for (int k = 0; k <= 1000; ++k) {
    const ObserverState o = at(s, k / 100.0);
    const std::string name = region_name(o.region, o.universe);
    if (regions.empty() || regions.back() != name) regions.push_back(name);
    EXPECT_TRUE(has_tetrad(o.region, o.tetrad));
    EXPECT_EQ(own_sky(o), SkyRegion::kIII);
  }
  EXPECT_THAT(regions, testing::ElementsAre("III", "II", "VI", "IV+1", "III+1"));
}

TEST_F(ChargedPassages, AnExtremalHoleHasNothingBetweenItsHorizons) {
  const Show s = read(
      "black_hole: {mass_solar: 4e6, charge: 1}\ntimeline:\n"
      "  - {duration_s: 10, trajectory: {type: infall, from_r: 12, to_r: 12, to_leg: outward}}\n");
  std::vector<std::string> regions;
  for (int k = 0; k <= 1000; ++k) {
    const ObserverState o = at(s, k / 100.0);
    const std::string name = region_name(o.region, o.universe);
    if (regions.empty() || regions.back() != name) regions.push_back(name);
  }
  EXPECT_THAT(regions, testing::ElementsAre("I", "V", "I+1"));
}

// What the picture shows is told by where its camera sees the light that comes along R, from outside
// and from the hole, and the south of the orbit.  None of them jumps where the tetrad changes.
TEST_F(ChargedPassages, NoCameraTurnsWhereTheTetradChanges) {
  for (const char* camera : {"{look_at: hole}", "{look_at: outward}", "{euler_deg: [20, 70, 5]}",
                             "{euler_deg: [0, 0, 0]}"}) {
    const Show s = show(
        "  - {duration_s: 2, trajectory: {type: infall, from_r: 12, angular_momentum: 2, "
        "from_leg: inward, to_r: 12, to_leg: outward, pace: steady}}\n",
        std::string("camera: ") + camera + "\n");
    const auto seen = [&](double t) {
      ObserverState o = at(s, t);
      o.tetrad_from_camera = camera_axes_at(s, 0, t, s.projection, o);
      std::array<V3d, 3> directions;
      for (const int side : {1, -1})
        directions[side > 0 ? 0 : 1] = apply_transposed(
            o.tetrad_from_camera, to_observer(o.celerity, V3d(side, 0, 0)).direction);
      directions[2] = apply_transposed(o.tetrad_from_camera, V3d(0, 1, 0));
      return directions;
    };
    ASSERT_EQ(at(s, 1 - 1e-9).tetrad, Tetrad::kRain);
    ASSERT_EQ(at(s, 1 + 1e-9).tetrad, Tetrad::kOutgoing);
    for (const double step : {1e-3, 1e-5, 1e-7})
      for (int k = -4; k < 4; ++k) {
        const auto a = seen(1 + (k + 0.5) * step), b = seen(1 + (k + 1.5) * step);
        for (std::size_t i = 0; i < 3; ++i)
          EXPECT_LT((a[i] - b[i]).length(), 400 * step + 1e-9) << camera << ' ' << k << ' ' << i;
      }
    const auto first = seen(1 - 1e-4), last = seen(1 + 1e-4);
    EXPECT_GT((first[0] - first[1]).length(), 0.1) << camera;
    EXPECT_GT((last[0] - last[1]).length(), 0.1) << camera;
  }
}

// ---- the sky of the next universe ----

TEST_F(ChargedPassages, WhatIsNotSaidOfTheNextSkyIsLikeRegionOne) {
  const std::string way = "  - {duration_s: 1, trajectory: {type: static, r: 9}}\n";
  const Show plain = show(way);
  EXPECT_EQ(plain.sky[SkyRegion::kNext], plain.sky[SkyRegion::kI]);
  const Show other = show(way,
                          "sky: {region_I: {background: grid, gain: 2, stars: naked_eye}, "
                          "region_III: {background: black}, next: {gain: 3}}\n");
  RegionSky expected = other.sky[SkyRegion::kI];
  expected.background_gain = 3;
  EXPECT_EQ(other.sky[SkyRegion::kNext], expected);
  EXPECT_FALSE(other.timeline[0].backgrounds[SkyRegion::kNext]);
  const Show own = show(
      "  - {duration_s: 1, trajectory: {type: static, r: 9}, sky: {next: {background: grid}}}\n");
  EXPECT_TRUE(std::holds_alternative<GridSky>(background_of(own, 0, SkyRegion::kNext)));
}

TEST_F(ChargedPassages, KeyframesChangeTheNextSky) {
  const Show s = show(
      "  - duration_s: 4\n    trajectory: {type: static, r: 9}\n    keyframes:\n"
      "      - {at_s: 0, sky: {next: {gain: 1, stars: {gain: 2, max_magnitude: 5}}}}\n"
      "      - {at_s: 4, sky: {next: {gain: 3, stars: {gain: 0, max_magnitude: 6}}}}\n",
      "frames_per_second: 1\nsky: {next: {}}\n");
  const FrameSettings::Sky begin = frame_state(s, 0).settings.sky[SkyRegion::kNext],
                           middle = frame_state(s, 2).settings.sky[SkyRegion::kNext];
  EXPECT_EQ(begin.background_gain, 1);
  EXPECT_EQ(begin.star_gain, 2);
  EXPECT_EQ(begin.max_magnitude, 5);
  EXPECT_DOUBLE_EQ(middle.background_gain, 2);
  EXPECT_DOUBLE_EQ(middle.star_gain, 1);
  EXPECT_DOUBLE_EQ(middle.max_magnitude, 5.5);
  EXPECT_EQ(frame_state(s, 2).settings.sky[SkyRegion::kIII].background_gain, 1);
}

TEST_F(ChargedPassages, NoNextSkyIsThereWithoutACharge) {
  const std::string way =
      "black_hole: {mass_solar: 1}\ntimeline:\n  - {duration_s: 1, trajectory: "
      "{type: static, r: 9}";
  const std::string told =
      "is the sky beyond a charged hole, through which the next universe is reached; give "
      "black_hole.charge";
  EXPECT_THAT(complaint(way + "}\nsky: {next: {background: grid}}\n"),
              testing::HasSubstr("4:13: sky.next " + told));
  EXPECT_THAT(complaint(way + ", sky: {next: {gain: 2}}}\n"),
              testing::HasSubstr("timeline[1].sky.next " + told));
  EXPECT_THAT(complaint(way + "}\nkeyframes: [{at_s: 0, sky: {next: {gain: 2}}}]\n"),
              testing::HasSubstr("keyframes[1].sky.next " + told));
}

TEST_F(ChargedPassages, LightCannotGoStraightBetweenTheHorizons) {
  EXPECT_THAT(
      complaint("black_hole: {mass_solar: 1, charge: 0.9}\neffects: {lensing: false}\n"
                "timeline:\n  - {duration_s: 20, trajectory: {type: infall, from_r: 9, to_r: 9, "
                "to_leg: outward}}\n"),
      testing::HasSubstr("effects.lensing can be false outside the horizon only (r > 1.435889894), "
                         "but frame "));
}

// ---- markers ----

TEST_F(ChargedPassages, MarkersTellTheLegsApart) {
  const Show s = show(
      "  - {duration_s: 10, trajectory: {type: infall, from_r: 12, to_r: 12, to_leg: outward}}\n",
      "markers: {in: {r: 0.5641101056}, turn: periastron, out: {r: 0.5641101056, leg: outward}, "
      "next: {r: 1.4358898944, leg: outward}, horizon: {r: 1.4358898944, leg: inward}}\n");
  const auto time_of = [&](const char* name) {
    const auto found = std::ranges::find(s.markers, name, &Marker::name);
    return found->at_s;
  };
  const double per_m = 10 / (2 * rain_time(12));
  EXPECT_NEAR(time_of("in"), 5 - per_m * rain_time(0.5641101056), 1e-7);
  EXPECT_NEAR(time_of("out"), 5 + per_m * rain_time(0.5641101056), 1e-7);
  EXPECT_NEAR(time_of("turn"), 5, 1e-6);
  EXPECT_NEAR(time_of("next"), 5 + per_m * rain_time(1.4358898944), 1e-7);
  EXPECT_NEAR(time_of("horizon"), 5 - per_m * rain_time(1.4358898944), 1e-7);
  EXPECT_THAT(
      complaint("black_hole: {mass_solar: 1}\nmarkers: {a: {r: 5, leg: outward}}\ntimeline:\n"
                "  - {duration_s: 1, trajectory: {type: infall, from_r: 9}}\n"),
      testing::HasSubstr(
          "happens nowhere in the show, which is never at r = 5 on its way outward"));
}

TEST_F(ChargedPassages, ASegmentEndsWhereAHorizonIsLeft) {
  const Show s = show(
      "  - {duration_s: in, trajectory: {type: infall, from_r: 2, rate_m_per_s: 0.5}}\n"
      "  - {duration_s: out, trajectory: {type: continue, rate_m_per_s: 0.1}}\n",
      "markers: {in: {r: 0.5641101056}, out: {r: 0.5641101056, leg: outward}}\n");
  EXPECT_NEAR(s.timeline[0].duration_s, (rain_time(2) - rain_time(0.5641101056)) / 0.5, 1e-9);
  EXPECT_NEAR(s.timeline[1].duration_s, 2 * rain_time(0.5641101056) / 0.1, 1e-7);
}

}  // namespace
}  // namespace domefall
