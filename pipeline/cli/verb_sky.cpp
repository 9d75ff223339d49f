#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>

#include "pipeline/cli/verbs.h"
#include "pipeline/image/errors.h"
#include "pipeline/show/assets.h"
#include "pipeline/sky/sky_file.h"
#include "pipeline/sky/starlight_map.h"

namespace domefall {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Deeper than any catalogue.
constexpr double kEveryStar = 30;

struct BuildOptions {
  std::string stars, out;
  double fainter_than = 6.5, blur_deg = 0.7, gain = 1;
  int size = 0;
};

// 0 is a face's own best size.
void check_size(int size, int largest) {
  if (size == 0) return;
  if (size < 4 || size > largest || (size & (size - 1)) != 0)
    throw InputError("--size " + std::to_string(size) +
                     ": the size of a face must be a power of two from 4 to " +
                     std::to_string(largest));
}

void build(const BuildOptions& o) {
  check_size(o.size, kLargestStarlightFace);
  const double blur = o.blur_deg * kDegree;
  const int size = o.size ? o.size : starlight_face(blur);
  if (std::numbers::pi / 2 / size > 1.5 * blur)
    throw InputError("--size " + std::to_string(size) + ": too coarse for a blur of " +
                     std::to_string(o.blur_deg) + " degrees; at least " +
                     std::to_string(static_cast<int>(std::ceil(60 / o.blur_deg))));
  const StarCatalogue catalogue = read_star_catalogue(o.stars, kEveryStar);
  const std::vector<FaintStar> stars = fainter_stars(catalogue, o.fainter_than);
  if (stars.empty())
    throw InputError(o.stars + ": no star is fainter than V = " + std::to_string(o.fainter_than));
  const StarlightMap light(stars, blur, size);
  char about[256];
  std::snprintf(
      about, sizeof about,
      "made by: domefall sky build, %zu stars fainter than V = %g, blur %g deg, gain %g\n",
      stars.size(), o.fainter_than, o.blur_deg, o.gain);
  NewSkyFile file(o.out, SkyMapKind::kThermal, sky_unit(o.gain * light.greatest()), size,
                  {about + ("source: " + std::filesystem::path(o.stars).filename().string()) + "\n",
                   std::nullopt});
  light.write(file.pyramid(), o.gain);
  file.finish();
  double flux = 0;
  for (const FaintStar& s : stars) flux += s.flux;
  std::fprintf(stderr,
               "%zu stars, %.6g W/m^2 of light; the map has %.6g W/m^2, times a gain of %g\n",
               stars.size(), flux, light.flux(), o.gain);
}

void add_build(CLI::App& sky) {
  CLI::App* verb = sky.add_subcommand(
      "build", "Make a starless Milky Way of a catalogue's faint stars, with their true colours");
  auto o = std::make_shared<BuildOptions>();
  verb->add_option("--stars", o->stars, "the catalogue")->required();
  verb->add_option("--out", o->out, "the .sky file to write")->required();
  verb->add_option("--fainter-than", o->fainter_than, "V magnitude of the brightest star taken")
      ->check(CLI::Range(-30.0, kEveryStar))
      ->capture_default_str();
  verb->add_option("--blur", o->blur_deg, "degrees; standard deviation of a star's light")
      ->check(CLI::Range(kNarrowestBlur / kDegree, kWidestBlur / kDegree))
      ->capture_default_str();
  verb->add_option("--size", o->size, "texels along a cube face, a power of two [by the blur]");
  verb->add_option("--gain", o->gain, "factor on the light")
      ->check(CLI::Range(1e-6, 1e6))
      ->capture_default_str();
  verb->callback([o] { build(*o); });
}

void info(const std::string& path, bool verify) {
  const SkyFile file = open_sky_file(path);
  const bool thermal = file.map.kind() == SkyMapKind::kThermal;
  std::printf("kind         %s\n",
              thermal ? "thermal: radiance and temperature" : "colour: working-space RGB");
  std::printf("unit         %.9g %s\n", file.map.unit(), thermal ? "W/m^2/sr" : "cd/m^2");
  std::printf("faces        6 of %d x %d, %zu levels, %.1f MB\n", file.map.levels()[0].size,
              file.map.levels()[0].size, file.map.levels().size(), static_cast<double>(file.map.bytes()) / 1e6);
  std::printf("picture      %s\n",
              file.origin.picture ? told(*file.origin.picture).c_str() : "none");
  std::fputs(file.origin.text.c_str(), stdout);
  if (!verify) return;
  verify_sky_file(path);
  std::puts("verified     every face is as it was written");
}

void add_info(CLI::App& sky) {
  CLI::App* verb = sky.add_subcommand("info", "Tell what a .sky file holds");
  auto file = std::make_shared<std::string>();
  auto verify = std::make_shared<bool>(false);
  verb->add_option("FILE", *file, "a .sky file")->required();
  verb->add_flag("--verify", *verify, "read it whole and compare every checksum");
  verb->callback([file, verify] { info(*file, *verify); });
}

}  // namespace

void add_sky(CLI::App& app) {
  CLI::App* sky = app.add_subcommand("sky", "Import, build, check and describe sky maps");
  sky->require_subcommand(1);
  add_build(*sky);
  add_info(*sky);
}

}  // namespace domefall
