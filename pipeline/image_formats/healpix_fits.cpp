#include "pipeline/image_formats/healpix_fits.h"

#include <fitsio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "pipeline/image/errors.h"
#include "pipeline/image/regular_file.h"

namespace domefall {
namespace {

constexpr int kLargestNside = 8192, kMostExtensions = 100;
constexpr std::string_view kStart = "SIMPLE  =";
// A HEALPix file marks missing pixels with this value, to within its rounding.
constexpr float kBad = -1.6375e30f, kBadWithin = 1e25f;

class Fits {
 public:
  // CFITSIO would unpack a packed file into memory, however large, so it is shown FITS alone.
  explicit Fits(const std::filesystem::path& path)
      : path_(path), file_bytes_(RegularFile(path).size()) {
    if (start_of_file(path, kStart.size()) != kStart) fail("this is not a FITS file");
    fits_open_diskfile(&file_, path.c_str(), READONLY, &status_);
    check("this is not a FITS file");
  }
  ~Fits() {
    int ignored = 0;
    if (file_) fits_close_file(file_, &ignored);
  }
  Fits(const Fits&) = delete;
  Fits(Fits&&) = delete;
  Fits& operator=(const Fits&) = delete;
  Fits& operator=(Fits&&) = delete;

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(path_.string() + ": " + what);
  }

  // Moves to the first binary table with a keyword NSIDE.
  void find_map() {
    for (int k = 1; k <= kMostExtensions; ++k) {
      int type = 0;
      fits_movabs_hdu(file_, k, &type, &status_);
      if (status_ == END_OF_FILE) {
        status_ = 0;
        fits_clear_errmsg();
        fail("there is no HEALPix map in it (no table with a keyword NSIDE)");
      }
      check("the file is damaged");
      if (type == BINARY_TBL && !text("NSIDE").empty()) return;
    }
    fail(fmt::format(
        "there is no HEALPix map among its first {} extensions (no table with a keyword NSIDE)",
        kMostExtensions));
  }

  // Returns the value without quotes and without spaces at its end.  It is empty if there is no
  // such keyword.
  std::string text(const std::string& keyword) {
    std::array<char, FLEN_VALUE> value{};
    int status = 0;
    fits_read_key(file_, TSTRING, keyword.c_str(), value.data(), nullptr, &status);
    return status == 0 ? value.data() : "";
  }

  int integer(const std::string& keyword) {
    int value = 0;
    fits_read_key(file_, TINT, keyword.c_str(), &value, nullptr, &status_);
    check("keyword " + keyword);
    return value;
  }

  std::vector<float> column(int number, std::size_t count) {
    int type = 0;
    long repeat = 0, width = 0, rows = 0;
    fits_get_coltype(file_, number, &type, &repeat, &width, &status_);
    fits_get_num_rows(file_, &rows, &status_);
    check(fmt::format("column {}", number));
    const bool whole = type != TSTRING && type >= 0 && repeat >= 1 && rows >= 1 &&
                       static_cast<std::size_t>(repeat) <= count &&
                       static_cast<std::size_t>(rows) <= count &&
                       static_cast<std::size_t>(repeat) * static_cast<std::size_t>(rows) == count;
    if (!whole)
      fail(fmt::format("column {} does not hold the {} numbers of a whole sky", number, count));
    check_length();
    std::vector<float> values(count);
    float bad = std::numeric_limits<float>::quiet_NaN();
    int any = 0;
    fits_read_col(file_, TFLOAT, number, 1, 1, static_cast<LONGLONG>(count), &bad, values.data(),
                  &any, &status_);
    check(fmt::format("column {} cannot be read to its end", number));
    return values;
  }

 private:
  // A header that states more than the file holds is found out before memory is taken.
  void check_length() {
    LONGLONG header = 0, data = 0, end = 0;
    fits_get_hduaddrll(file_, &header, &data, &end, &status_);
    LONGLONG row = 0, rows = 0;
    fits_read_key(file_, TLONGLONG, "NAXIS1", &row, nullptr, &status_);
    fits_read_key(file_, TLONGLONG, "NAXIS2", &rows, nullptr, &status_);
    check("the size of the table");
    const std::uint64_t left =
        file_bytes_ - std::min(file_bytes_, static_cast<std::uint64_t>(data));
    if (row < 1 || rows < 1 ||
        static_cast<std::uint64_t>(rows) > left / static_cast<std::uint64_t>(row))
      fail(fmt::format(
          "the file is cut short: its table of {} rows of {} bytes is longer than the file", rows,
          row));
  }

  void check(const std::string& what) const {
    if (status_ == 0) return;
    std::array<char, FLEN_STATUS> reason{};
    fits_get_errstatus(status_, reason.data());
    fits_clear_errmsg();
    fail(what + ": " + reason.data());
  }

  std::filesystem::path path_;
  std::uint64_t file_bytes_;
  fitsfile* file_ = nullptr;
  int status_ = 0;
};

}  // namespace

HealpixFile read_healpix_fits(const std::filesystem::path& path, int column) {
  Fits fits(path);
  fits.find_map();
  HealpixFile map;
  map.nside = fits.integer("NSIDE");
  if (map.nside < 1 || map.nside > kLargestNside || (map.nside & (map.nside - 1)) != 0)
    fits.fail(fmt::format("NSIDE must be a power of two from 1 to 8192, got {}", map.nside));
  const std::string ordering = fits.text("ORDERING");
  if (!ordering.starts_with("RING") && !ordering.starts_with("NEST"))
    fits.fail("ORDERING must be RING or NESTED, got '" + ordering + "'");
  map.nested = ordering.starts_with("NEST");
  if (fits.text("INDXSCHM") == "EXPLICIT")
    fits.fail("it lists its pixels (INDXSCHM EXPLICIT); only maps of the whole sky can be read");
  if (column < 1 || column > fits.integer("TFIELDS"))
    fits.fail(fmt::format("it has no column {}", column));
  map.coordinates = fits.text("COORDSYS");
  map.units = fits.text(fmt::format("TUNIT{}", column));
  const auto side = static_cast<std::size_t>(map.nside);
  map.values = fits.column(column, 12 * side * side);
  for (float& v : map.values)
    if (!std::isfinite(v) || std::abs(v - kBad) < kBadWithin)
      v = std::numeric_limits<float>::quiet_NaN();
  return map;
}

}  // namespace domefall
