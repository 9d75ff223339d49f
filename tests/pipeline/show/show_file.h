// Fixtures that write show files into a folder of its own, with stand-ins for the shipped assets.
#pragma once

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/show/file/read_show.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/observer_track.h"
#include "pipeline/sources/stars/star_file.h"
#include "tests/pipeline/image/test_folder.h"
#include "trajectories/degree.h"
#include "trajectories/equatorial.h"

namespace domefall {

class ShowFile : public TestFolder {
 protected:
  ShowFile() {
    write("assets/milky_way.sky", "");
    write("assets/milky_way_deep.sky", "");
    write("assets/dome.ocio", "");
    write_star_file(folder_ / "assets/stars_to_9.stars", three_stars());
    write("assets/sky_places.csv",
          "name,ra_deg,dec_deg\n"
          "Orion,85.39,5.69\nM 31,10.6847,41.2687\nAndromeda Galaxy,10.6847,41.2687\n"
          "galactic centre,266.405,-28.9362\nVega,1,2\n");
    write("assets/figures.csv",
          "constellation,abbreviation,line,ra_deg,dec_deg\n"
          "Orion,Ori,1,88.793,7.407\nOrion,Ori,1,81.283,6.350\nOrion,Ori,2,78.634,-8.202\n"
          "Orion,Ori,2,83.002,-0.299\nOrion,Ori,2,81.283,6.350\nLyra,Lyr,1,279.235,38.784\n"
          "Lyra,Lyr,1,281.085,39.670\n");
    setenv("DOMEFALL_ASSETS", (folder_ / "assets").c_str(), 1);
  }
  ~ShowFile() override { unsetenv("DOMEFALL_ASSETS"); }
  ShowFile(const ShowFile&) = delete;
  ShowFile& operator=(const ShowFile&) = delete;

  static RawCatalogue three_stars() {
    RawCatalogue catalogue;
    const auto add = [&catalogue](double ra, double dec, float v, float b_v, const char* name,
                                  const char* designation) {
      const auto number = static_cast<std::uint32_t>(catalogue.stars.size());
      CatalogueStar star{};
      star.direction = sky_direction(ra, dec);
      star.v = v;
      star.colour = b_v;
      catalogue.stars.push_back(star);
      for (const char* each : {name, designation}) catalogue.names.push_back({number, each});
    };
    add(101.287, -16.716, -1.44f, 0.009f, "Sirius", "alpha CMa");
    add(279.235, 38.784, 0.03f, -0.001f, "Vega", "alpha Lyr");
    add(88.793, 7.407, 0.45f, 1.5f, "Betelgeuse", "alpha Ori");
    return catalogue;
  }

  std::filesystem::path write(const std::string& name, const std::string& bytes) {
    const auto file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    // If it were truncated instead, ext4 would flush each of thousands of files to the disk.
    std::filesystem::remove(file);
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

  Show read(const std::string& yaml) { return read_show(write("show.yaml", yaml)); }

  // Returns the message, without the folder, of the error of either kind that reading it throws, or
  // an empty text if it throws none.
  std::string complaint(const std::string& yaml) {
    std::string message = message_of<std::runtime_error>([&] { read(yaml); });
    const std::string folder = folder_.string() + "/";
    for (auto at = message.find(folder); at != std::string::npos; at = message.find(folder))
      message.erase(at, folder.size());
    return message;
  }
};

// ---- what the keys of a show mean ----

class ShowKeys : public ShowFile {
 protected:
  // Reads a show with one segment and further lines.
  Show with(const std::string& more, const std::string& trajectory = "{type: infall, from_r: 30}",
            const std::string& hole = "{mass_solar: 4e6}") {
    return read("black_hole: " + hole +
                "\ntimeline:\n  - {duration_s: 10, trajectory: " + trajectory + "}\n" + more);
  }
  Segment segment(const std::string& trajectory, const std::string& hole = "{mass_solar: 4e6}") {
    return with("", trajectory, hole).timeline.at(0);
  }
  // The celerity of a segment of type `velocity`.
  V3d celerity(const std::string& keys, const std::string& hole = "{mass_solar: 4e6}") {
    return std::get<GivenVelocity>(segment("{type: velocity, " + keys + "}", hole).trajectory)
        .celerity;
  }
  std::filesystem::path asset(const std::string& name) { return folder_ / "assets" / name; }
};

// A .stars file rounds the components of directions to 2^-31.
inline constexpr double kStarPlace = 1e-9;

// This allows for products and quotients of a few rounded numbers.
inline void expect_near(const V3d& a, const V3d& b, double tolerance = 1e-14) {
  EXPECT_LE((a - b).length(), tolerance * std::max(1.0, b.length())) << a << " and " << b;
}

inline SkyDirection place(double ra_deg, double dec_deg) {
  const double ra = ra_deg * kDegree, dec = dec_deg * kDegree;
  return {V3d(std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec))};
}

// ---- broken shows and the messages about them ----

class ShowMistakes : public ShowFile {
 protected:
  struct Mistake {
    std::string yaml;
    // The message without the file's name, with which every line begins: "3:7: size must be ...".
    std::string told;
  };

  static inline const std::string kHole = "black_hole: {mass_solar: 1}\n";
  // These two lines are right.
  static inline const std::string kShow =
      kHole + "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}]\n";

  static std::string moving(const std::string& trajectory) {
    return kHole + "timeline:\n  - {duration_s: 2, trajectory: " + trajectory + "}\n";
  }

  void expect_complaints(const std::vector<Mistake>& mistakes) {
    EXPECT_EQ(complaint(kShow), "");
    for (const auto& [yaml, message] : mistakes) {
      std::string told = "show.yaml:" + message;
      for (auto at = told.find('\n'); at != std::string::npos; at = told.find('\n', at + 1))
        told.insert(at + 1, "show.yaml:");
      EXPECT_EQ(complaint(yaml), told) << yaml;
    }
  }
  // The same of lines behind kHole, or behind kShow.
  void expect_complaints_behind_hole(std::vector<Mistake> mistakes) {
    for (Mistake& m : mistakes) m.yaml = kHole + m.yaml + "\n";
    expect_complaints(mistakes);
  }
  void expect_complaints_of_lines(std::vector<Mistake> mistakes) {
    for (Mistake& m : mistakes) m.yaml = kShow + m.yaml + "\n";
    expect_complaints(mistakes);
  }
  // The same of trajectories, whose name is left out of what is told: "3:51: r must exceed ...".
  void expect_complaints_of_trajectories(std::vector<Mistake> mistakes) {
    for (auto& [yaml, told] : mistakes) {
      yaml = moving(yaml);
      told.insert(told.find(' ') + 1, "timeline[1].trajectory.");
    }
    expect_complaints(mistakes);
  }
};

// ---- shows that are a timeline near a hole, and what their observers do ----

class ObservedShow : public ShowFile {
 protected:
  Show show(const std::string& segments, const std::string& more = "") {
    return read("black_hole: {mass_solar: 4e6}\n" + more + "timeline:\n" + segments);
  }
  // The proper time per second of show at an instant.
  static double rate_at(const Show& s, double t) {
    const double h = 1e-5;
    const int k = segment_at(s, t);
    const auto tau = [&](double at) { return observer_at(s, k, part_at(s, k, at)).proper_time; };
    return (tau(t + h) - tau(t - h)) / (2 * h);
  }
  static ObserverState at(const Show& s, double t) {
    const int k = segment_at(s, t);
    return observer_at(s, k, part_at(s, k, t));
  }
};

}  // namespace domefall
