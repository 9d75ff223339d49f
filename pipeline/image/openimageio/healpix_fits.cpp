#include "pipeline/image/openimageio/healpix_fits.h"

#include <fitsio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"

namespace domefall {
namespace {

// A file that lists its pixels may be small, and so is held to a sky of 0.8 GB in memory.
constexpr int kLargestNside = 8192, kLargestListed = 4096, kMostExtensions = 100;
constexpr std::string_view kStart = "SIMPLE  =";
// A HEALPix file marks missing pixels with this value, to within its rounding.
constexpr float kBad = -1.6375e30f, kBadWithin = 1e25f;

// Returns the letters and digits of a keyword's value in capitals: programs differ in quotes,
// blanks and case.
std::string plain_word(std::string_view value) {
  std::string word;
  for (const char c : value) {
    if (c >= 'a' && c <= 'z') word += static_cast<char>(c - 'a' + 'A');
    if ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) word += c;
  }
  return word;
}

// Returns NSIDE of a sky of so many pixels, which is 12 NSIDE^2, or 0 if there is none.
int nside_of(std::uint64_t pixels) {
  for (std::uint64_t nside = 1; nside <= kLargestNside; nside *= 2)
    if (pixels == 12 * nside * nside) return static_cast<int>(nside);
  return 0;
}

class Fits {
 public:
  // CFITSIO would unpack a packed file into memory, however large, so it is shown FITS alone.
  Fits(const std::filesystem::path& path, std::string_view unpacked)
      : path_(path),
        file_bytes_(unpacked.empty() ? RegularFile(path).size() : unpacked.size()),
        unpacked_(unpacked.data()),
        unpacked_size_(unpacked.size()) {
    if (unpacked.empty()) {
      if (start_of_file(path, kStart.size()) != kStart) fail("this is not a FITS file");
      fits_open_diskfile(&file_, path.c_str(), READONLY, &status_);
    } else {
      if (!unpacked.starts_with(kStart)) fail("this is not a FITS file, packed by gzip");
      // Of a file in memory that is only read, nothing is written either.
      fits_open_memfile(&file_, path.c_str(), READONLY, const_cast<void**>(&unpacked_),
                        &unpacked_size_, 0, nullptr, &status_);
    }
    check("this is not a FITS file");
  }
  ~Fits() {
    int ignored = 0;
    if (file_) fits_close_file(file_, &ignored);
  }
  Fits(const Fits&) = delete;
  Fits& operator=(const Fits&) = delete;

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(path_.string() + ": " + what);
  }

  // Moves to the first binary table that says of itself that it is a map or, failing that, whose
  // first column has as many pixels as a map.
  void find_map() {
    if (!find_table([this] { return has("NSIDE") || plain_word(text("PIXTYPE")) == "HEALPIX"; }) &&
        !find_table([this] { return nside_of(size(1)) != 0; }))
      fail(
          fmt::format("there is no HEALPix map among its first {} extensions (no table with a "
                      "keyword NSIDE, or with as many pixels as a map)",
                      kMostExtensions));
  }

  bool has(const std::string& keyword) { return !text(keyword).empty(); }

  // Returns how many numbers a column has, or 0 where it is missing or of text.
  std::uint64_t size(int number) {
    int type = 0, status = 0;
    long repeat = 0, width = 0, rows = 0;
    fits_get_coltype(file_, number, &type, &repeat, &width, &status);
    fits_get_num_rows(file_, &rows, &status);
    if (status != 0 || type == TSTRING || type < 0 || repeat < 1 || rows < 1) {
      fits_clear_errmsg();
      return 0;
    }
    const auto in_row = static_cast<std::uint64_t>(repeat);
    const auto count = static_cast<std::uint64_t>(rows);
    return count > std::numeric_limits<std::uint64_t>::max() / in_row ? 0 : in_row * count;
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
    check_length();
    std::vector<float> values(count);
    float bad = std::numeric_limits<float>::quiet_NaN();
    int any = 0;
    fits_read_col(file_, TFLOAT, number, 1, 1, static_cast<LONGLONG>(count), &bad, values.data(),
                  &any, &status_);
    check(fmt::format("column {} cannot be read to its end", number));
    return values;
  }

  std::vector<LONGLONG> pixels(std::size_t count) {
    check_length();
    std::vector<LONGLONG> numbers(count);
    LONGLONG none = -1;
    int any = 0;
    fits_read_col(file_, TLONGLONG, 1, 1, 1, static_cast<LONGLONG>(count), &none, numbers.data(),
                  &any, &status_);
    check("the column of pixel numbers cannot be read to its end");
    return numbers;
  }

 private:
  // Moves to the first binary table of which `fits` is true, and says whether there is one.
  template <class Test>
  bool find_table(Test fits) {
    for (int k = 1; k <= kMostExtensions; ++k) {
      int type = 0;
      fits_movabs_hdu(file_, k, &type, &status_);
      if (status_ == END_OF_FILE) {
        status_ = 0;
        fits_clear_errmsg();
        return false;
      }
      check("the file is damaged");
      if (type == BINARY_TBL && fits()) return true;
    }
    return false;
  }

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
  const void* unpacked_;  // of a packed file
  std::size_t unpacked_size_;
  fitsfile* file_ = nullptr;
  int status_ = 0;
};

// Returns NSIDE as the file states it or, where it lists the whole sky, by the number of pixels.
int nside_stated(Fits& fits, bool whole, int column) {
  const int nside = fits.has("NSIDE") ? fits.integer("NSIDE")
                    : whole           ? nside_of(fits.size(column))
                                      : 0;
  if (nside == 0 && !fits.has("NSIDE"))
    fits.fail(whole
                  ? fmt::format("it has no keyword NSIDE, and the {} numbers of column {} are not "
                                "those of a whole sky",
                                fits.size(column), column)
                  : "it lists its pixels, and has no keyword NSIDE");
  const int most = whole ? kLargestNside : kLargestListed;
  if (nside < 1 || nside > most || (nside & (nside - 1)) != 0)
    fits.fail(fmt::format("NSIDE must be a power of two from 1 to {}{}, got {}", most,
                          whole ? "" : " in a map that lists its pixels", nside));
  return nside;
}

bool is_nested(Fits& fits) {
  const std::string ordering = plain_word(fits.text("ORDERING"));
  if (ordering.empty())
    fits.fail(
        "it does not say how its pixels are numbered (no keyword ORDERING, which is RING or "
        "NESTED)");
  if (!ordering.starts_with("RING") && !ordering.starts_with("NEST"))
    fits.fail("ORDERING must be RING or NESTED, got '" + fits.text("ORDERING") + "'");
  return ordering.starts_with("NEST");
}

// Returns the pixels of a map that lists the numbers of some in its first column.  All others are
// NaN.
std::vector<float> listed_pixels(Fits& fits, int column, std::size_t sky) {
  const std::uint64_t count = fits.size(1);
  if (count == 0 || count > sky || fits.size(column) != count)
    fits.fail(fmt::format("columns 1 and {} must have as many pixel numbers as values, at most {}",
                          column, sky));
  const std::vector<LONGLONG> numbers = fits.pixels(count);
  const std::vector<float> values = fits.column(column, count);
  std::vector<float> whole(sky, std::numeric_limits<float>::quiet_NaN());
  std::vector<bool> seen(sky);
  for (std::size_t k = 0; k < count; ++k) {
    const auto number = static_cast<std::uint64_t>(numbers[k]);
    if (numbers[k] < 0 || number >= sky)
      fits.fail(fmt::format("entry {} of column 1 is {}; pixels are numbered from 0 to {}", k + 1,
                            numbers[k], sky - 1));
    if (seen[number]) fits.fail(fmt::format("pixel {} is listed twice", number));
    seen[number] = true;
    whole[number] = values[k];
  }
  return whole;
}

}  // namespace

HealpixFile read_healpix_fits(const std::filesystem::path& path, std::string_view unpacked,
                              int column) {
  Fits fits(path, unpacked);
  fits.find_map();
  const std::string scheme = plain_word(fits.text("INDXSCHM"));
  const bool whole =
      scheme.empty() ? plain_word(fits.text("OBJECT")) != "PARTIAL" : scheme != "EXPLICIT";
  const int fields = fits.integer("TFIELDS");
  // The pixel numbers of a map that lists them stand before its columns.
  const int number = whole ? column : column + 1;
  if (column < 1 || number > fields) fits.fail(fmt::format("it has no column {}", column));
  HealpixFile map;
  map.nside = nside_stated(fits, whole, number);
  map.nested = is_nested(fits);
  map.coordinates = plain_word(fits.text("COORDSYS"));
  map.units = fits.text(fmt::format("TUNIT{}", number));
  const auto side = static_cast<std::size_t>(map.nside);
  const std::size_t sky = 12 * side * side;
  if (whole && fits.size(number) != sky)
    fits.fail(fmt::format("column {} does not hold the {} numbers of a whole sky", number, sky));
  map.values = whole ? fits.column(number, sky) : listed_pixels(fits, number, sky);
  for (float& v : map.values)
    if (!std::isfinite(v) || std::abs(v - kBad) < kBadWithin)
      v = std::numeric_limits<float>::quiet_NaN();
  return map;
}

}  // namespace domefall
