// Tests with thousands of damaged shows.  Each is either refused, with places, or read as a show
// that has all its frames.  The seed is fixed, so that a failure comes back, and a failure prints
// the show.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <sstream>

#include "pipeline/show/frame_state.h"
#include "tests/pipeline/show/show_file.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

const char* const kGoodShows[] = {
    "title: Fall\n"
    "size: 1k\n"
    "black_hole: {mass_solar: 4.3e6, at: Sirius, heading_deg: 20}\n"
    "camera: {look_at: hole, roll_deg: 5, dome_tilt_deg: 10}\n"
    "timeline:\n"
    "  - {duration_s: 2, trajectory: {type: infall, from_r: 30, to_r: 3}}\n"
    "  - {duration_s: 2, trajectory: {type: infall, from_r: 3, pace: slowing}}\n"
    "  - duration_s: 1.5\n"
    "    trajectory: {type: circular, r: 6, orbits: 2}\n"
    "    camera: {look_at: motion, elevation_deg: 30}\n",

    "frames_per_second: 24\n"
    "size: [320, 200]\n"
    "black_hole:\n"
    "  mass_solar: 10\n"
    "  at: {ra_deg: 83, dec_deg: -5.5}\n"
    "camera:\n"
    "  projection: stereographic\n"
    "  fov_deg: 100\n"
    "  euler_deg: [10, 120, -4]\n"
    "effects: {aberration: false, intensity: false, amplification: everything}\n"
    "timeline:\n"
    "  - duration_s: 3\n"
    "    trajectory:\n"
    "      type: velocity\n"
    "      r: 1.4\n"
    "      lorentz_factor: 12\n"
    "      against: free_fall\n"
    "      direction: {radial: 1, theta: 2, phi: 3}\n"
    "  - duration_s: 3\n"
    "    trajectory: {type: velocity, r: 9, speed: 0.4, direction: Vega}\n"
    "  - &stay\n"
    "    duration_s: 1\n"
    "    trajectory: {type: static, r: 2.001}\n"
    "  - *stay\n"
    "disc: {inner_r: 7, outer_r: 25, inclination_deg: 40, node_deg: -20, t_max_k: 6000, pattern: "
    "{type: spot, r: 9}}\n",

    "sky:\n"
    "  region_I: {background: grid, gain: 2, stars: {max_magnitude: 5, gain: 0.5}}\n"
    "  region_III: {background: black, stars: none}\n"
    "  blueshift_power: 3\n"
    "  epoch: 2026.5\n"
    "effects: {lensing: false, doppler_colour: false, amplification: none}\n"
    "stars: {min_sigma_deg: 0.1, growth: 0.1, reference_magnitude: 4, max_sigma_deg: 0.5}\n"
    "exposure: {ev: 2}\n"
    "grade:\n"
    "  display: \"Dome\"\n"
    "  cdl: {slope: [1, 0.9, 1.1], offset: 0.01, power: 1.1, saturation: 0.9}\n"
    "output: {graded: tiff16}\n"
    "timeline:\n"
    "  - {duration_s: 1}\n"
    "  - {duration_s: 2, trajectory: {type: velocity, speed: 0.9, direction: Betelgeuse}}\n",
};

using Random = std::mt19937;  // the same numbers everywhere, unlike the standard's distributions

std::size_t below(Random& random, std::size_t bound) { return random() % bound; }

// Bytes that mean something to YAML or to numbers, and two that are no text.
char meaningful_byte(Random& random) {
  static const std::string kBytes = "{}[]:,-#&*!|>'\"%@`?~.0123456789eE+<= \t\n\r\x7F\xC3\xFF_nai";
  return kBytes[below(random, kBytes.size())];
}

std::string with_lines_swapped(const std::string& text, Random& random) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  std::swap(lines[below(random, lines.size())], lines[below(random, lines.size())]);
  std::string out;
  for (const std::string& line : lines) out += line + "\n";
  return out;
}

std::string mutated(std::string text, Random& random) {
  const std::size_t at = below(random, text.size());
  const std::size_t length = 1 + below(random, std::min<std::size_t>(8, text.size() - at));
  switch (below(random, 6)) {
    case 0:
      return text.erase(at, length);
    case 1:
      return text.insert(at, text.substr(at, length));
    case 2:
      return text.insert(at, 1, meaningful_byte(random));
    case 3:
      text[at] = meaningful_byte(random);
      return text;
    case 4: {
      // The digits of a number are changed, so that many mutants are shows.
      const std::size_t digit = text.find_first_of("0123456789", at);
      if (digit != std::string::npos) text[digit] = static_cast<char>('0' + below(random, 10));
      return text;
    }
    default:
      return with_lines_swapped(text, random);
  }
}

bool is_finite(const V3d& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void expect_finite_frame(const Show& show, int frame) {
  const FrameState s = frame_state(show, frame);
  const ObserverState& o = s.observer;
  EXPECT_TRUE(std::isfinite(s.show_time_s));
  EXPECT_TRUE(std::isfinite(o.proper_time));
  EXPECT_GT(o.r, 0);
  EXPECT_EQ(o.r == kFlatSpace, show.spacetime.is_flat());
  EXPECT_TRUE(is_finite(o.celerity)) << o.celerity;
  // Where all of the sky gathers ahead within 1/gamma, the camera's target rounds with gamma.
  const double rounding = 1e-12 + 1e-17 * o.celerity.length();
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(column(o.sky_from_tetrad, k).length(), 1, 1e-12);
    EXPECT_NEAR(column(o.tetrad_from_camera, k).length(), 1, rounding);
  }
}

void expect_finite_numbers(const Show& show) {
  const PointSpreadLaw& law = show.point_spread;
  std::vector<double> numbers;
  numbers.insert(numbers.end(),
                 {show.frames_per_second, show.heading, show.spacetime.seconds_per_m(),
                  show.panorama_shift.blueshift_power, show.star_epoch, show.exposure.ev,
                  law.min_sigma, law.growth, law.reference_magnitude, law.max_sigma, law.halo,
                  law.halo_sigma, law.white_core, show.grade.cdl.saturation});
  for (const auto& channels : {show.grade.cdl.slope, show.grade.cdl.offset, show.grade.cdl.power})
    numbers.insert(numbers.end(), channels.begin(), channels.end());
  for (const RegionSky& sky : {show.sky[SkyRegion::kI], show.sky[SkyRegion::kIII]})
    numbers.insert(numbers.end(), {sky.background_gain, sky.star_gain,
                                   sky.stars.value_or(StarField{}).max_magnitude});
  for (const Segment& s : show.timeline) {
    numbers.insert(numbers.end(),
                   {s.duration_s, double(s.timing.tau_begin), double(s.timing.tau_end),
                    s.camera.roll, s.camera.elevation, s.camera.dome_tilt});
    EXPECT_GT(s.duration_s, 0);
    EXPECT_GE(s.timing.tau_end, s.timing.tau_begin);
  }
  EXPECT_THAT(numbers, testing::Each(testing::Truly([](double x) { return std::isfinite(x); })));
}

class ShowFuzz : public ShowFile {
 protected:
  // Reads a text, and returns whether it is a show.
  bool survives(const std::string& yaml) {
    try {
      const Show show = read(yaml);
      expect_finite_numbers(show);
      const int count = frame_count(show);
      EXPECT_GE(count, 1);
      EXPECT_LE(count, kMostFrames);
      expect_finite_frame(show, 0);
      expect_finite_frame(show, count - 1);
      return true;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith((folder_ / "show.yaml:").string()));
      EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("-nan")));
    } catch (const TemporaryError& error) {  // of a file that is not there
      EXPECT_THAT(error.what(), testing::StartsWith((folder_ / "show.yaml:").string()));
    }
    return false;
  }

  void run(int mutants, int most_mutations) {
    Random random(20260101);
    int shows = 0;
    for (int k = 0; k < mutants; ++k) {
      std::string yaml = kGoodShows[static_cast<std::size_t>(k) % std::size(kGoodShows)];
      const std::size_t mutations = 1 + below(random, static_cast<std::size_t>(most_mutations));
      for (std::size_t m = 0; m < mutations && !yaml.empty(); ++m) yaml = mutated(yaml, random);
      shows += survives(yaml);
      ASSERT_FALSE(HasFailure()) << "mutant " << k << ":\n" << yaml;
    }
    // Both kinds are frequent enough that the test means something.
    EXPECT_GT(shows, mutants / 25);
    EXPECT_GT(mutants - shows, mutants / 20);
    RecordProperty("shows", shows);
  }
};

TEST_F(ShowFuzz, TheGoodShowsAreGood) {
  for (const char* show : kGoodShows) EXPECT_TRUE(survives(show)) << show;
}

TEST_F(ShowFuzz, SlightlyDamagedShowsAreReadOrRefused) { run(tries(2000, 400), 1); }

TEST_F(ShowFuzz, BadlyDamagedShowsAreReadOrRefused) { run(tries(2000, 1000), 5); }

TEST_F(ShowFuzz, ShowsCutAnywhereAreReadOrRefused) {
  for (const std::string show : kGoodShows)
    for (std::size_t length = 0; length < show.size(); ++length) {
      survives(show.substr(0, length));
      ASSERT_FALSE(HasFailure()) << show.substr(0, length);
    }
}

TEST_F(ShowFuzz, ExtremeNumbersWithinTheBoundsStayFinite) {
  const std::string hole = "black_hole: {mass_solar: ";
  for (const char* mass : {"1e-20", "1e-9", "1e13"})
    for (const char* duration : {"0.02", "300000"})
      for (const char* trajectory :
           {"{type: infall, from_r: 1e9, to_r: 10}", "{type: infall, from_r: 100, to_r: 1e-6}",
            "{type: infall, from_r: 1e9, to_r: 10, pace: slowing}",
            "{type: infall, from_r: 1.1e-6, to_r: 1e-6, pace: slowing}",
            "{type: circular, r: 3.0000000001, orbits: 1e6}", "{type: circular, r: 1e9}",
            "{type: circular, r: 9, time_lapse: 1e12}", "{type: static, r: 2.0000000000001}",
            "{type: velocity, r: 2.0000000000001, lorentz_factor: 1e9, direction: Vega}",
            "{type: velocity, r: 1e-6, against: free_fall, speed: 0.9999999999999999, direction: "
            "outward}"})
        for (const char* look_at : {"hole", "Sirius"}) {
          const std::string yaml = hole + mass + "}\ncamera: {look_at: " + look_at +
                                   "}\ntimeline: [{duration_s: " + duration +
                                   ", trajectory: " + trajectory + "}]\n";
          survives(yaml);
          ASSERT_FALSE(HasFailure()) << yaml;
        }
}

// Every number of a trajectory is next to 0, to the largest double, to a bound, or beyond one.
TEST_F(ShowFuzz, NumbersOfAnySizeInTrajectoriesAreReadOrRefused) {
  const std::vector<std::string> trajectories{
      "{type: static, r: @}",
      "{type: static, r: 9, rate_m_per_s: @}",
      "{type: static, r: 9, time_lapse: @}",
      "{type: circular, r: @, orbits: @}",
      "{type: circular, r: 9, rate_m_per_s: @}",
      "{type: circular, r: 9, time_lapse: @}",
      "{type: parabolic, periastron: @, from_r: 20}",
      "{type: parabolic, excess: @, from_r: 20}",
      "{type: parabolic, angular_momentum: @, from_r: @}",
      "{type: parabolic, periastron: 8, from_tau_m: @, to_tau_m: @}",
      "{type: hyperbolic, v_inf: @, periastron: @, from_r: 20}",
      "{type: hyperbolic, v_inf: @, impact_parameter: @, from_r: 20}",
      "{type: hyperbolic, v_inf: 0.5, excess: @, from_r: 20}",
      "{type: hyperbolic, periastron: 3.5, excess: @, from_r: 20}",
      "{type: bound, periastron: @, apoastron: @}",
      "{type: bound, semilatus_rectum: @, eccentricity: @}",
      "{type: bound, eccentricity: 0.5, excess: @}",
      "{type: infall, from_r: @}",
      "{type: infall, from_r: @, to_r: @}",
      "{type: infall, from_r: 6, rate_m_per_s: @}",
      "{type: infall, from_r: @, rate_m_per_s: 1}",
      "{type: infall, rest_r: @}",
      "{type: infall, rest_r: 12, angular_momentum: @}",
      "{type: infall, from_r: 6, angular_momentum: @}",
      "{type: infall, from_r: 6, v_inf: @, impact_parameter: @}",
      "{type: infall, rest_r: 12, from_tau_m: @, to_tau_m: @}",
      "{type: thrown, from_r: @, speed: 0.3, direction: inward}",
      "{type: thrown, from_r: 8, speed: @, direction: forward}",
      "{type: thrown, from_r: 8, lorentz_factor: @, direction: outward}",
      "{type: thrown, from_r: 8, speed: 0.3, direction: {radial: @, phi: @}}",
      "{type: thrown, from_r: 8, speed: 0.3, direction: {radial: 1, theta: @}}",
      "{type: kruskal, energy: @}",
      "{type: kruskal, energy: 0.8, angular_momentum: @}",
      "{type: kruskal, energy: 0, angular_momentum: @}",
      "{type: kruskal, angular_momentum: @}",
      "{type: kruskal, energy: @, angular_momentum: @}",
      "{type: spiral, from_r: @}",
      "{type: spiral, from_r: @, turns: @, to_r: @}",
      "{type: spiral, from_r: 9, turns: @, rate_m_per_s: @}",
      "{type: braked, from_r: @, stop_r: @}",
      "{type: braked, from_r: @, stop_r: @, speed: @}",
      "{type: braked, from_r: 9, stop_r: 3, to_r: @}",
      "{type: braked, from_r: 9, stop_r: 3, to_tau_m: @, speed: @}",
      "{type: velocity, r: @, speed: @, direction: forward}",
      "{type: velocity, r: 8, speed: [@, @], direction: outward}",
      "{type: velocity, r: 8, speed: 0.3, direction: {radial: @, phi: @}}",
      "{type: path, keyframes: [{at_m: 0, r: 8}, {at_m: @, r: @, azimuth_deg: @}]}",
      "{type: path, keyframes: [{at_m: 0, r: 8}, {at_m: 9, r: 8, speed: @, direction: forward}]}"};
  std::istringstream sizes(
      "0 -0.0 5e-324 1e-308 1e-200 1e-162 1e-150 1e-100 1e-20 1e-17 1e-9 1e-6 0.1000000000000001 "
      "0.9999999999999999 1.9999999999999998 2.0000000000000004 3.0000000000000004 "
      "3.9999999999999996 4.000000000000001 6 1e6 1e9 1e15 1e150 1e308 -1e-308 -1e308");
  const std::vector<std::string> numbers(std::istream_iterator<std::string>(sizes), {});
  Random random(20260102);
  for (const std::string& trajectory : trajectories)
    for (const std::string& number : numbers)
      for (int tried = 0; tried < tries(2, 1); ++tried) {
        std::string yaml = trajectory;
        // The first place takes each number, and all others take any.
        bool first = true;
        for (std::size_t at = yaml.find('@'); at != std::string::npos; at = yaml.find('@')) {
          yaml.replace(at, 1, first ? number : numbers[below(random, numbers.size())]);
          first = false;
        }
        survives("black_hole: {mass_solar: 4e6}\ntimeline: [{duration_s: 1, trajectory: " + yaml +
                 "}]\n");
        ASSERT_FALSE(HasFailure()) << yaml;
      }
}

}  // namespace
}  // namespace domefall
