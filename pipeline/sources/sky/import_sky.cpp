#include "pipeline/sources/sky/import_sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/unpacked_file.h"
#include "pipeline/image/read_image.h"
#include "pipeline/sources/sky/panorama.h"
#include "pipeline/sources/sky/sky_file.h"

namespace domefall {
namespace {

[[noreturn]] void refuse_import(const SkyImport& import, const std::string& what) {
  throw InputError(import.image.string() + ": " + what);
}

// Says whether a file is of FITS.  Its first card is SIMPLE, whose name takes 8 bytes and is
// followed by '=' (FITS standard 4.0, sec. 4.1.2 and 4.4.1).  Only maps are packed by gzip.
bool is_fits(const std::filesystem::path& path) {
  constexpr std::string_view kStart = "SIMPLE  =";
  const std::string start = start_of_file(path, kStart.size());
  return start == kStart || is_gzip(start);
}

SkyOrigin written_origin(const SkyImport& import, const Orientation& orientation,
                         const std::string& more) {
  return {fmt::format("source: {}\n{}{}", import.image.filename().string(), more, import.text),
          orientation, import.fainter_than};
}

Orientation import_panorama(const SkyImport& import) {
  if (import.cmb) refuse_import(import, "the microwave background comes as a HEALPix map");
  const LightImage image = read_light_image(import.image, import.encoding);
  const int width = image.pixels.width, height = image.pixels.height;
  if (width < 4 || height < 2 || width != 2 * height)
    refuse_import(
        import,
        fmt::format("an equirectangular picture is twice as wide as high, at least 4 x 2 pixels; "
                    "this one is {} x {}",
                    width, height));
  const double luminance = import.unit.value_or(kPanoramaUnit);
  NewSkyFile file(import.out, SkyMapKind::kColour, panorama_unit(image, luminance),
                  import.size ? import.size : panorama_face(width),
                  written_origin(import, import.orientation, kTakenAs + image.taken + "\n"));
  paint_panorama(image, import.orientation, luminance, file.pyramid());
  file.finish();
  return import.orientation;
}

SkyFrame frame_of(const SkyImport& import, const HealpixFile& file) {
  if (import.frame_given) return import.orientation.frame;
  // The FITS keyword COORDSYS has a letter (G, C, Q or E) or a word.
  const std::string& c = file.coordinates;
  const auto begins = [&c](std::initializer_list<std::string_view> words) {
    return std::ranges::any_of(words, [&c](std::string_view word) { return c.starts_with(word); });
  };
  if (c == "G" || begins({"GAL"})) return SkyFrame::kGalactic;
  if (c == "C" || c == "Q" || begins({"CEL", "EQ", "ICRS", "FK5", "J2000", "RADEC"}))
    return SkyFrame::kEquatorial;
  if (c.empty()) refuse_import(import, "it does not say in which coordinates it is; give --frame");
  refuse_import(
      import,
      fmt::format("its coordinates (COORDSYS) are '{}'{}; only galactic and equatorial are read", c,
                  c == "E" ? ", which are ecliptic" : ""));
}

// Returns the number of kelvin in the unit of TUNIT: "K", "mK,thermodynamic", "uK_CMB" and the
// like.
double kelvin_of(const SkyImport& import, const std::string& units) {
  if (import.unit) return *import.unit;
  if (units.starts_with('K')) return 1;
  if (units.starts_with("mK") || units.starts_with("milliK")) return 1e-3;
  if (units.starts_with("uK") || units.starts_with("microK") || units.starts_with("muK"))
    return 1e-6;
  refuse_import(
      import, fmt::format("it does not say in what its temperatures are (TUNIT is '{}'); give the "
                          "kelvin of a value of 1 as --unit",
                          units));
}

// Returns the line by which read_sky() recognises a microwave background.
std::string cmb_text(const CmbSettings& cmb) {
  return fmt::format("{}at redshift {:f}, contrast {:f}\n", kMicrowaveBackground, cmb.redshift,
                     cmb.contrast);
}

// Refuses a map whose pixels are all bad (NaN) and one without light.  The fluctuations of a
// microwave background may be negative.
void check_texels(const SkyImport& import, const HealpixFile& healpix) {
  bool good = false;
  // Both begin at 0, as check_light() takes them.
  float least = 0, most = 0;
  for (const float v : healpix.values) {
    if (std::isnan(v)) continue;
    good = true;
    least = std::min(least, v);
    most = std::max(most, v);
  }
  if (!good)
    refuse_import(import,
                  fmt::format("column {} holds no value: all {} pixels are missing (UNSEEN, NaN or "
                              "infinite)",
                              import.column, healpix.values.size()));
  if (!import.cmb) check_light(import.image, least, most);
}

// Makes a map of a HEALPix file, thermal for a microwave background and else grey, and returns the
// orientation that its file states.
Orientation import_healpix(const SkyImport& import) {
  HealpixFile healpix = read_healpix(import.image, import.column);
  check_texels(import, healpix);
  Orientation orientation;
  orientation.frame = frame_of(import, healpix);
  CmbSettings cmb = import.cmb.value_or(CmbSettings{});
  if (import.cmb) cmb.kelvin = kelvin_of(import, healpix.units);
  // Missing pixels become 0, which is dark in a colour map and the mean temperature in a thermal
  // one.
  const HealpixMap map(std::move(healpix), 0);
  const double luminance = import.unit.value_or(kPanoramaUnit);
  SkyOrigin origin = written_origin(import, orientation, "");
  // The settings of the microwave background become a line of their own in the text.
  if (import.cmb) origin.text += cmb_text(cmb);
  NewSkyFile file(import.out, import.cmb ? SkyMapKind::kThermal : SkyMapKind::kColour,
                  import.cmb ? cmb_unit(cmb) : healpix_unit(map, luminance),
                  import.size ? import.size : healpix_face(map.nside()), std::move(origin));
  if (import.cmb)
    paint_cmb(map, orientation.frame, cmb, file.pyramid());
  else
    paint_healpix(map, orientation.frame, luminance, file.pyramid());
  file.finish();
  return orientation;
}

}  // namespace

std::string taken_in(const std::string& text) {
  const std::size_t line = text.find(std::string("\n") + kTakenAs);
  if (line == std::string::npos) return "";
  const std::size_t begin = line + 1 + std::string_view(kTakenAs).size();
  return text.substr(begin, text.find('\n', begin) - begin);
}

Orientation import_sky(const SkyImport& import) {
  require_file(import.image);
  const bool healpix = import.projection == SkyProjection::kHealpix ||
                       (import.projection == SkyProjection::kOfFile && is_fits(import.image));
  return healpix ? import_healpix(import) : import_panorama(import);
}

}  // namespace domefall
