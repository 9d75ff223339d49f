#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "pipeline/base/csv_file.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/talk.h"
#include "pipeline/base/unpacked_file.h"
#include "pipeline/sources/stars/catalogue_formats.h"
#include "pipeline/sources/stars/raw_catalogue.h"
#include "pipeline/sources/stars/star_colour.h"
#include "pipeline/sources/stars/stellarium_zones.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMagic = 0x835f040a;

// A file begins with this header.  Magnitudes are in thousandths.  From version 25 of Stellarium
// on, the epoch stands in the place of the range, as a Julian date in a float, and the header ends
// with it.
struct Header {
  std::uint32_t magic;
  std::int32_t type, major, minor, level, mag_min, mag_range, mag_steps;
};
static_assert(sizeof(Header) == 32);
constexpr std::size_t kGaiaHeader = 28;

// The places of these files are those of J2016.0, which is this Julian date.
constexpr float kGaiaDate = 2457389.0F;
constexpr double kGaiaEpoch = 2016;

// This is a star within its zone.  x0 and x1 are its place along the zone's axes in units of their
// largest value.  The motions, in 0.1 mas a year, go to the star's own east and north, and they are
// stretched as the zone's plane is there.  This was found by comparison with Hipparcos' motions
// over 100 mas a year.  Half of these agree to 5 % in zones of level 0, to 1.4 % at level 1 and to
// 0.4 % at level 2.
struct Packed {
  double x0, x1, motion0, motion1;
  int colour, magnitude;
  std::uint32_t hip;
};

struct Full {
  std::uint32_t hip_and_component;
  std::int32_t x0, x1;
  std::uint8_t colour, magnitude;
  std::uint16_t spectrum;
  std::int32_t motion0, motion1, parallax;
};
static_assert(sizeof(Full) == 28);

// Returns a star of type 0.  The bytes are copied, since a record need not be aligned in the file.
Packed unpack_full(const char* bytes) {
  Full star;
  std::memcpy(&star, bytes, sizeof star);
  constexpr double kLargest = 2147483647;
  constexpr std::uint32_t kHipBits = 0xffffff;
  return {star.x0 / kLargest,
          star.x1 / kLargest,
          static_cast<double>(star.motion0),
          static_cast<double>(star.motion1),
          star.colour,
          star.magnitude,
          star.hip_and_component & kHipBits};
}

// Returns the number that is held by `count` bits from bit `first` on, of which the first is the
// least significant.
std::int64_t bits(const char* bytes, int first, int count, bool is_signed) {
  std::int64_t value = 0;
  for (int i = 0; i < count; ++i) {
    const int bit = first + i;
    const auto byte = static_cast<unsigned char>(bytes[bit / 8]);
    value |= static_cast<std::int64_t>((byte >> (bit % 8)) & 1) << i;
  }
  // The highest bit of a signed number counts as -2^(count - 1).
  const bool negative = is_signed && ((value >> (count - 1)) & 1) != 0;
  return negative ? value - (std::int64_t{1} << count) : value;
}

// Returns a star that is packed into bits without a Hipparcos number.  x0 and x1 have so many with a
// sign, and so have two motions, of which there may be none.  The colour of 7 bits and the magnitude
// of 5 follow.
Packed unpack_bits(const char* bytes, int place, int motion) {
  const double largest = std::ldexp(1, place - 1) - 1;
  const auto motion_at = [&](int first) {
    return motion == 0 ? 0 : static_cast<double>(bits(bytes, first, motion, true));
  };
  const int behind = 2 * (place + motion);
  return {static_cast<double>(bits(bytes, 0, place, true)) / largest,
          static_cast<double>(bits(bytes, place, place, true)) / largest,
          motion_at(2 * place),
          motion_at(2 * place + motion),
          static_cast<int>(bits(bytes, behind, 7, false)),
          static_cast<int>(bits(bytes, behind + 7, 5, false)),
          0};
}

constexpr std::array<std::size_t, 3> kSizes{sizeof(Full), 10, 6};

class Reader {
 public:
  explicit Reader(const fs::path& path) : file_(require_file(path)) {
    if (bytes().size() < sizeof head_) fail(bytes().size(), "the file ends within its header");
    std::memcpy(&head_, bytes().data(), sizeof head_);
    if (head_.magic != kMagic)
      fail(0, "this is no catalogue of Stellarium's, or one of another byte order");
    if (head_.type < 0 || head_.type > 2)
      fail(4, fmt::format("stars of type {}; those of types 0 to 2 can be read", head_.type));
    if (head_.level < 0 || head_.level > kDeepestZones)
      fail(16, fmt::format("level {} is beyond 0 to {}", head_.level, kDeepestZones));
    gaia_ = std::bit_cast<float>(head_.mag_range) == kGaiaDate;
    if (gaia_) return;
    // No star is fainter than V = 40 (kFaintestV), which is 40,000 in thousandths.  A step count of
    // 0 would be divided by.
    if (head_.mag_steps < 1 || head_.mag_range < 0 || std::abs(head_.mag_min) > 40000 ||
        head_.mag_range > 40000)
      fail(20, "the range of magnitudes makes no sense");
  }

  bool is_of_gaia() const { return gaia_; }

  // Appends all stars of the file.  Their number in each zone precedes them.
  void read(std::vector<CatalogueStar>& stars) const {
    const auto type = static_cast<std::size_t>(head_.type);
    const std::size_t size = gaia_ ? kStellariumGaiaSizes[type] : kSizes[type];
    const std::size_t header = gaia_ ? kGaiaHeader : sizeof head_;
    // Files made of Gaia's data have one more zone, for what belongs to none.
    const std::vector<std::uint32_t> counts =
        zone_sizes(header, zone_count(head_.level) + (gaia_ ? 1 : 0));
    const std::uint64_t total = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    const std::size_t first = header + counts.size() * sizeof(std::uint32_t);
    // The size of the file checks the table of zones, so that no record is read beyond its end.
    if (total * size != bytes().size() - first)
      fail(first, fmt::format("the zones should have {} stars in {} bytes, but {} follow",
                              with_commas(total), with_commas(total * size),
                              with_commas(bytes().size() - first)));
    std::size_t at = first;
    if (gaia_) {
      for (; at < bytes().size(); at += size) stars.push_back(gaia_star(at));
      return;
    }
    const StellariumZones grid(head_.level);
    for (std::size_t zone = 0; zone < counts.size(); ++zone)
      for (std::uint32_t i = 0; i < counts[zone]; ++i, at += size)
        stars.push_back(star(grid, zone, at));
  }

 private:
  std::string_view bytes() const { return file_.bytes(); }

  [[noreturn]] void fail(std::size_t byte, const std::string& what) const {
    throw InputError(fmt::format("{}: byte {}: {}", file_.path().string(), byte, what));
  }

  std::vector<std::uint32_t> zone_sizes(std::size_t header, std::size_t zones) const {
    if ((bytes().size() - header) / sizeof(std::uint32_t) < zones)
      fail(bytes().size(), "the file ends within its table of zones");
    std::vector<std::uint32_t> counts(zones);
    std::memcpy(counts.data(), bytes().data() + header, zones * sizeof(std::uint32_t));
    return counts;
  }

  CatalogueStar gaia_star(std::size_t at) const {
    CatalogueStar out = stellarium_gaia_star(head_.type, bytes().data() + at);
    // A place of 0 has no direction, and the tests are negated against NaN.
    if (!(std::abs(out.direction.v.length2() - 1) < 1e-3) || !(out.v >= kBrightestV) ||
        !(out.v <= kFaintestV) || out.hip > kLastHip ||
        !(std::hypot(out.pm_ra, out.pm_dec) <= kFastest))
      fail(at, "the record that begins here is no star");
    if (out.pm_ra != 0 || out.pm_dec != 0)
      out.direction = moved(out.direction, out.pm_ra, out.pm_dec, 2000 - kGaiaEpoch);
    return out;
  }

  CatalogueStar star(const StellariumZones& grid, std::size_t zone, std::size_t at) const {
    // B-V goes in 127 steps from -0.5 to 3.5.
    constexpr double kMasPerUnit = 0.1, kMillimagnitude = 1e-3, kColourSteps = 127,
                     kColourRange = 4, kBluestStep = -0.5;
    const char* place = bytes().data() + at;
    const Packed packed = head_.type == 0   ? unpack_full(place)
                          : head_.type == 1 ? unpack_bits(place, 20, 14)
                                            : unpack_bits(place, 18, 0);
    if (packed.colour > kColourSteps || packed.magnitude > head_.mag_steps)
      fail(at, "this star's colour or magnitude is beyond the table's range");
    CatalogueStar out;
    const StellariumZones::Place found = grid.place(zone, packed.x0, packed.x1);
    out.direction = found.direction;
    out.pm_ra = static_cast<float>(kMasPerUnit * packed.motion0 / found.stretch);
    out.pm_dec = static_cast<float>(kMasPerUnit * packed.motion1 / found.stretch);
    out.v = static_cast<float>(kMillimagnitude *
                               (head_.mag_min + static_cast<double>(packed.magnitude) *
                                                    head_.mag_range / head_.mag_steps));
    out.colour = colour_of_b_v(packed.colour * kColourRange / kColourSteps + kBluestStep);
    out.hip = packed.hip;
    return out;
  }

  UnpackedFile file_;
  Header head_{};
  bool gaia_ = false;
};

// Returns the catalogues of a folder in the order of their names, so that the result does not
// depend on the order in which the system lists them.
Paths catalogues_in(const fs::path& folder) {
  Paths files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    // The files stars_hip_*.cat are tables of spectral types and components.
    if (name.starts_with("stars_") && name.ends_with(".cat") && !name.starts_with("stars_hip"))
      files.push_back(entry->path());
  }
  if (error) throw TemporaryError(folder.string() + ": " + error.message());
  std::sort(files.begin(), files.end());
  if (files.empty()) throw InputError(folder.string() + ": holds no stars_*.cat");
  return files;
}

// Replaces the motions of the brighter stars by those of hip_pm.dat.  These are Hipparcos' own and
// lack the errors that Packed has.
void take_motions(const fs::path& file, std::vector<CatalogueStar>& stars) {
  std::unordered_map<std::uint32_t, std::pair<float, float>> motions;
  CsvFile row(file, '\t', {"hip", "pm_ra", "pm_dec"});
  while (row.next())
    motions[static_cast<std::uint32_t>(row.required("hip", 1, kLastHip))] = {
        static_cast<float>(row.required("pm_ra", -kFastest, kFastest)),
        static_cast<float>(row.required("pm_dec", -kFastest, kFastest))};
  for (CatalogueStar& star : stars)
    if (const auto found = motions.find(star.hip); star.hip != 0 && found != motions.end())
      std::tie(star.pm_ra, star.pm_dec) = found->second;
}

}  // namespace

ImportedCatalogue import_stellarium(const Paths& inputs) {
  ImportedCatalogue out;
  bool gaia = false;
  for (const fs::path& input : inputs) {
    std::error_code ignored;
    const Paths files = fs::is_directory(input, ignored) ? catalogues_in(input) : Paths{input};
    for (const fs::path& file : files) {
      const Reader reader(file);
      reader.read(out.catalogue.stars);
      gaia = gaia || reader.is_of_gaia();
    }
    // Below an input that is a file there is no such path, so that only a folder brings motions.
    if (const fs::path motions = input / "hip_pm.dat"; fs::is_regular_file(motions, ignored))
      take_motions(motions, out.catalogue.stars);
  }
  identify_by_hipparcos(out.catalogue.stars);
  out.catalogue.text = {gaia ? "Stellarium's star catalogues, from Hipparcos and Gaia DR3 (ESA)"
                             : "Stellarium's star catalogues, from Hipparcos, Tycho-2 and NOMAD",
                        gaia ? "as Stellarium's (GPL-2+)" : "GPL-2+ as in Debian's stellarium-data",
                        ""};
  return out;
}

}  // namespace domefall
