// A fixture that writes show files into a folder of its own, with stand-ins for the shipped assets.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "pipeline/image/errors.h"
#include "pipeline/show/read_show.h"
#include "pipeline/sky/catalogue/star_file.h"
#include "tests/pipeline/image/test_folder.h"
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
    try {
      read(yaml);
    } catch (const std::runtime_error& error) {
      std::string message = error.what();
      const std::string folder = folder_.string() + "/";
      for (auto at = message.find(folder); at != std::string::npos; at = message.find(folder))
        message.erase(at, folder.size());
      return message;
    }
    return "";
  }
};

}  // namespace domefall
