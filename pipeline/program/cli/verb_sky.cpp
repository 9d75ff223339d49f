#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/talk.h"
#include "pipeline/base/utf8.h"
#include "pipeline/image/image_formats.h"
#include "pipeline/image/read_image.h"
#include "pipeline/program/cli/number_in.h"
#include "pipeline/program/cli/option_types.h"
#include "pipeline/program/cli/output_file.h"
#include "pipeline/program/cli/sky_page.h"
#include "pipeline/program/cli/verbs.h"
#include "pipeline/show/assets.h"
#include "pipeline/sources/sky/import_sky.h"
#include "pipeline/sources/sky/read_sky.h"
#include "pipeline/sources/sky/sky_file.h"
#include "pipeline/sources/sky/starlight_map.h"
#include "pipeline/sources/stars/star_catalogue.h"
#include "trajectories/degree.h"

namespace domefall {
namespace {

// This V is fainter than every catalogue's last star.
constexpr double kEveryStar = 40;

struct BuildOptions {
  std::string stars, out;
  double fainter_than = 9, blur_deg = 0.7, smooth_to = 10, gain = 1;
  int size = 0;
};

// Refuses a size that no face may have.  0 leaves the size to the program.
void check_size(int size, int largest) {
  if (size == 0) return;
  if (size < 4 || size > largest || (size & (size - 1)) != 0)
    throw InputError(fmt::format(
        "--size {}: the size of a face must be a power of two from 4 to {}", size, largest));
}

void build(const BuildOptions& o) {
  check_size(o.size, kLargestStarlightFace);
  const double blur = o.blur_deg * kDegree;
  const int size = o.size ? o.size : starlight_face(blur);
  if (std::numbers::pi / 2 / size > 1.5 * blur)
    throw InputError(
        fmt::format("--size {}: too coarse for a blur of {:f} degrees; at least {:.0f}", size,
                    o.blur_deg, std::ceil(60 / o.blur_deg)));
  require_file(o.stars);
  refuse_overwriting(o.out, o.stars);
  OutputFile out(o.out);
  const StarCatalogue catalogue = read_star_catalogue(o.stars, kEveryStar);
  const std::vector<FaintStar> stars = fainter_stars(catalogue, o.fainter_than);
  if (stars.empty())
    throw InputError(fmt::format("{}: no star is fainter than V = {:f}", o.stars, o.fainter_than));
  StarlightMap light(size);
  for (const BlurClass& spread : blur_classes(stars, blur, o.smooth_to))
    light.add(spread.stars, spread.blur);
  const std::string about = fmt::format(
      "made by: domefall sky build, {} stars fainter than V = {:g}, blur {:g} deg, "
      "smooth to V = {:g}, gain {:g}\n"
      "source: {}\n",
      stars.size(), o.fainter_than, o.blur_deg, o.smooth_to, o.gain,
      std::filesystem::path(o.stars).filename().string());
  NewSkyFile file(out.path(), SkyMapKind::kThermal, sky_unit(o.gain * light.greatest()), size,
                  {about, std::nullopt, o.fainter_than});
  light.write(file.pyramid(), o.gain);
  file.finish();
  out.finish();
  double flux = 0;
  for (const FaintStar& s : stars) flux += s.flux;
  say(fmt::format("{} stars, {:.6g} W/m^2 of light; the map has {:.6g} W/m^2, times a gain of {:g}",
                  stars.size(), flux, light.flux(), o.gain));
}

void add_build(CLI::App& sky) {
  CLI::App* verb = sky.add_subcommand(
      "build", "Make a starless Milky Way of a catalogue's faint stars, with their true colours");
  auto o = std::make_shared<BuildOptions>();
  add_file(*verb, "--stars", o->stars, "the catalogue")->required();
  add_file(*verb, "--out", o->out, "the .sky file to write")->required();
  add_number(*verb, "--fainter-than", o->fainter_than, "V magnitude of the brightest star taken",
             -30.0, kEveryStar);
  add_number(*verb, "--blur", o->blur_deg, "degrees; standard deviation of a star's light",
             kNarrowestBlur / kDegree, kWidestBlur / kDegree);
  add_number(*verb, "--smooth-to", o->smooth_to,
             "stars brighter than this V are spread wider, so that none stands out", -30.0,
             kEveryStar);
  verb->add_option("--size", o->size, "texels along a cube face, a power of two [by the blur]");
  add_number(*verb, "--gain", o->gain, "factor on the light", 1e-6, 1e6);
  verb->callback([o] { build(*o); });
}

struct InfoOptions {
  std::string file;
  bool verify = false, json = false;
};

void info(const InfoOptions& o) {
  require_file(o.file);
  if (!is_sky_file(o.file) && !o.verify) {
    const std::string page = picture_page(picture_taken(o.file), o.json);
    fmt::print("{}", o.json ? page : printable_lines(page));
    return;
  }
  const SkyFile file(o.file);
  if (o.json && o.verify) file.verify();  // a damaged file is refused before anything is printed
  // The text in it is another program's.
  fmt::print("{}", o.json ? sky_json(file, o.verify) : printable_lines(sky_page(file)));
  if (!o.verify || o.json) return;
  file.verify();
  fmt::print("verified     every face is as it was written\n");
}

void add_sky_info(CLI::App& sky) {
  CLI::App* verb =
      sky.add_subcommand("info", "Tell what a .sky file holds, or as what a picture is taken");
  auto o = std::make_shared<InfoOptions>();
  add_file(*verb, "FILE", o->file, "a .sky file, or a picture")->required();
  verb->add_flag("--verify", o->verify, "read it whole and compare every checksum");
  verb->add_flag("--json", o->json, "the same facts as JSON, for other programs");
  verb->callback([o] { info(*o); });
}

// Reads the stars to check with.  They are those of the named file, or those that come with
// Domefall where none is named.
StarCatalogue check_stars(const std::string& file) {
  if (!file.empty()) require_file(file);
  return read_star_catalogue(file.empty() ? shipped_asset(kStandardStars).string() : file,
                             kEveryStar);
}

void check_map(const std::string& path, const std::string& stars) {
  require_file(path);
  Orientation stated;
  if (is_sky_file(path)) stated = SkyFile(path).origin().panorama.value_or(stated);
  const auto map = read_sky(path).map;
  const StarCatalogue catalogue = check_stars(stars);
  const SkyCheck check = check_orientation(*map, stated, catalogue);
  print_check(check, known_places(*map, catalogue));
  if (check.verdict == SkyVerdict::kOther) throw InputError(path + ": " + verdict_sentence(check));
  fmt::print("\n{}\n", verdict_sentence(check));
}

void add_check_of_sky(CLI::App& sky) {
  CLI::App* verb = sky.add_subcommand(
      "check", "Tell by stars and Milky Way whether a map lies on the sky as it is said to");
  auto file = std::make_shared<std::string>(), stars = std::make_shared<std::string>();
  add_file(*verb, "FILE", *file, "a .sky file, or a panorama as shows take it")->required();
  add_file(*verb, "--stars", *stars, "a catalogue [that which comes with Domefall]");
  verb->callback([file, stars] { check_map(*file, *stars); });
}

struct ImportOptions {
  SkyImport import;
  std::string image, out, projection = "auto", frame, licence, stars;
  bool left = false, right = false, linear = false, srgb = false, cmb = false;
  double unit = 0, fainter_than = kEveryStar;
  CmbSettings background;
};

SkyImport import_of(const ImportOptions& o) {
  SkyImport import = o.import;
  import.image = o.image;
  require_file(o.image);
  refuse_overwriting(o.out, o.image);
  check_size(import.size, kLargestFace);
  if (o.projection == "equirectangular") import.projection = SkyProjection::kEquirectangular;
  if (o.projection == "healpix") import.projection = SkyProjection::kHealpix;
  import.frame_given = !o.frame.empty();
  if (o.frame == "galactic") import.orientation.frame = SkyFrame::kGalactic;
  import.orientation.longitude_right = o.right;
  if (o.linear) import.encoding = PixelEncoding::kLinear;
  if (o.srgb) import.encoding = PixelEncoding::kSrgb;
  if (o.unit > 0) import.unit = o.unit;
  if (o.cmb) import.cmb = o.background;
  if (o.fainter_than < kEveryStar) import.fainter_than = o.fainter_than;
  if (!o.licence.empty()) import.text = "licence: " + o.licence + "\n";
  return import;
}

void import_map(const ImportOptions& o) {
  SkyImport import = import_of(o);
  OutputFile out(o.out);
  import.out = out.path();
  const Orientation stated = import_sky(import);
  const SkyFile made(out.path());
  if (const std::string taken = taken_in(made.origin().text); !taken.empty())
    say(fmt::format("{} is taken as: {}", o.image, taken));
  say(fmt::format("{}: {}", o.out, orientation_phrase(stated)));
  const StarCatalogue catalogue = check_stars(o.stars);
  const SkyCheck check = check_orientation(made.map(), stated, catalogue);
  say((check.verdict == SkyVerdict::kOther ? "warning: " : "") + verdict_sentence(check));
  out.finish();
}

void add_orientation(CLI::App& verb, ImportOptions& o) {
  verb.add_option("--frame", o.frame,
                  "equatorial (J2000) or galactic [equatorial; HEALPix: what the file says]")
      ->check(CLI::IsMember({"equatorial", "galactic"}));
  CLI::Option* left = verb.add_flag(
      "--ra-left", o.left, "longitude grows to the left, as seen from inside [so it does]");
  verb.add_flag("--ra-right,--flip", o.right, "longitude grows to the right")->excludes(left);
  verb.add_flag("--south-up", o.import.orientation.south_up, "the top row is the south pole");
  add_number(verb, "--centre-ra,--centre-longitude", o.import.orientation.centre_deg,
             "longitude of the middle column, degrees", -360.0, 360.0);
}

void add_cmb(CLI::App& verb, ImportOptions& o) {
  CLI::Option* cmb = verb.add_flag(
      "--cmb", o.cmb, "the map holds fluctuations of the microwave background's temperature");
  add_number(verb, "--cmb-redshift", o.background.redshift,
             "it is shown as it was at this redshift", 250.0, 1e5)
      ->needs(cmb);
  add_number(verb, "--cmb-contrast", o.background.contrast, "factor on the fluctuations", 0.0, 1e6)
      ->needs(cmb);
  add_number(verb, "--cmb-luminance", o.background.luminance, "cd/m^2, of its mean temperature",
             1e-9, 1e3)
      ->needs(cmb);
}

void add_sky_import(CLI::App& sky) {
  CLI::App* verb = sky.add_subcommand("import", "Make a .sky file of a picture of the whole sky");
  auto o = std::make_shared<ImportOptions>();
  add_file(*verb, "IMAGE", o->image,
           fmt::format("an {} file, or a HEALPix map in FITS", kPictureFormats))
      ->required();
  add_file(*verb, "--out", o->out, "the .sky file to write")->required();
  verb->add_option("--projection", o->projection, "of the picture; auto: as the file tells")
      ->check(CLI::IsMember({"auto", "equirectangular", "healpix"}))
      ->capture_default_str();
  add_orientation(*verb, *o);
  verb->add_option("--unit", o->unit,
                   "cd/m^2 of a value of 1 [1e-4]; with --cmb: kelvin [what the file says]")
      ->check(number_in(1e-12, 1e12));
  CLI::Option* linear = verb->add_flag("--linear", o->linear, "values are linear light");
  verb->add_flag("--srgb", o->srgb, "values are sRGB-encoded [as the file says]")->excludes(linear);
  verb->add_option("--size", o->import.size,
                   "texels along a cube face, a power of two [as fine as the picture]");
  verb->add_option("--fainter-than", o->fainter_than,
                   "it holds the light of stars fainter than this V, and of no others [unknown]")
      ->check(number_in(-30.0, kEveryStar));
  verb->add_option("--column", o->import.column, "of a HEALPix file")->capture_default_str();
  add_cmb(*verb, *o);
  verb->add_option("--licence", o->licence, "a line to keep in the file: credit and terms");
  add_file(*verb, "--stars", o->stars,
           "the catalogue to check with [that which comes with Domefall]");
  verb->callback([o] { import_map(*o); });
}

}  // namespace

void add_sky(CLI::App& app) {
  CLI::App* sky = app.add_subcommand("sky", "Import, build, check and describe sky maps");
  sky->require_subcommand(1);
  add_sky_import(*sky);
  add_build(*sky);
  add_check_of_sky(*sky);
  add_sky_info(*sky);
}

}  // namespace domefall
