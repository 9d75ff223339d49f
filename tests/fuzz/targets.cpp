// libFuzzer's targets, one for each kind of file that Domefall reads.  One program holds them all,
// since linking takes longer than compiling: the build gives it a link for each folder in corpus/, and
// the name by which it is called, fuzz_<target>, chooses.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include "pipeline/base/csv_file.h"
#include "pipeline/base/digest.h"
#include "pipeline/base/errors.h"
#include "pipeline/grade/grader.h"
#include "pipeline/image/frame_check.h"
#include "pipeline/image/frame_file.h"
#include "pipeline/image/read_image.h"
#include "pipeline/show/file/read_show.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/sources/sky/sky_file.h"
#include "pipeline/sources/stars/amend_catalogue.h"
#include "pipeline/sources/stars/catalogue_formats.h"
#include "pipeline/sources/stars/star_catalogue.h"
#include "pipeline/sources/stars/star_file.h"

namespace domefall {
namespace {

// Returns a file with these bytes, the same each time, in a folder of this process's own, which is the
// working folder too: a name in an input is looked for in that folder.
std::filesystem::path input_file(std::string_view bytes, const char* name = "input") {
  static const std::filesystem::path folder = [] {
    auto made =
        std::filesystem::temp_directory_path() / ("domefall_fuzz_" + std::to_string(getpid()));
    std::filesystem::create_directories(made);
    std::atexit([] {
      std::error_code ignored;
      std::filesystem::remove_all(folder, ignored);
    });
    return made;
  }();
  std::ofstream(folder / name, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return folder / name;
}

// ---- catalogues of stars ----

void check(const RawCatalogue& catalogue) {
  for (const CatalogueStar& star : catalogue.stars)
    if (!std::isfinite(star.v) || !std::isfinite(star.direction.v.x)) std::abort();
}

RawCatalogue sirius() {
  CatalogueStar star;
  star.direction.v = {1, 0, 0};
  star.v = -1.44f;
  star.hip = 32349;
  RawCatalogue catalogue;
  catalogue.stars.push_back(star);
  return catalogue;
}

// For import: the first byte names the format, or what is laid over them.
void catalogue(std::string_view bytes) {
  if (bytes.empty()) return;
  const auto file = input_file(bytes.substr(1));
  const auto formats = catalogue_formats();
  const std::size_t choice =
      (static_cast<std::uint8_t>(bytes[0]) - std::size_t{'0'}) % (formats.size() + 4);
  RawCatalogue catalogue = sirius();
  if (choice < formats.size())
    catalogue = formats[choice].import({file}).catalogue;
  else if (choice == formats.size())
    apply_corrections(catalogue, file);
  else if (choice == formats.size() + 1)
    add_names(catalogue, file);
  else if (choice == formats.size() + 2)
    guess_format({file});
  else
    read_star_catalogue(file, 6, 2100);
  check(catalogue);
}

std::string_view part(std::string_view bytes, std::uint64_t at, std::uint64_t size) {
  return at > bytes.size() ? std::string_view() : bytes.substr(at, size);
}

// Makes the checksums of a .stars file right, so that what they guard is reached.
std::string repaired_stars(std::string bytes) {
  StarFileHeader head;
  if (bytes.size() < sizeof head) return bytes;
  std::memcpy(&head, bytes.data(), sizeof head);
  const std::uint64_t blocks = (head.stars + kBlockStars - 1) / kBlockStars;
  for (std::uint64_t k = 0; k < std::min<std::uint64_t>(blocks, 8); ++k) {
    const std::uint64_t at = head.index_at + k * sizeof(StarBlock);
    if (at > bytes.size() || bytes.size() - at < sizeof(StarBlock)) break;
    const std::uint64_t first = k * kBlockStars;
    const auto count = std::min<std::uint64_t>(kBlockStars, head.stars - first);
    const std::uint64_t sum =
        checksum(part(bytes, head.records_at + first * head.record_size, count * head.record_size));
    std::memcpy(bytes.data() + at, &sum, sizeof sum);
  }
  head.index_sum = checksum(part(bytes, head.index_at, blocks * sizeof(StarBlock)));
  head.text_sum = checksum(part(bytes, head.text_at, head.text_size));
  head.names_sum = checksum(part(bytes, head.names_at, head.names_size));
  head.file_size = bytes.size();
  head.head_sum =
      checksum({reinterpret_cast<const char*>(&head), offsetof(StarFileHeader, head_sum)});
  std::memcpy(bytes.data(), &head, sizeof head);
  return bytes;
}

void star_file(std::string_view bytes) {
  const auto file = input_file(repaired_stars(std::string(bytes)), "input.stars");
  const StarCatalogue catalogue =
      read_star_catalogue(file, std::numeric_limits<double>::infinity(), 2100);
  for (const Star& star : catalogue.stars)
    if (!std::isfinite(star.direction.v.x) || !std::isfinite(star.v_magnitude)) std::abort();
}

// ---- pictures, maps and frames ----

// By their header and, where they are small, by their pixels.
void picture(std::string_view bytes) {
  constexpr int kMostPixels = 1 << 20;  // larger ones would take the time of many others
  const auto file = input_file(bytes);
  const ImageLayout layout = InputImage(file).layout();
  if (layout.width > kMostPixels / layout.height ||
      layout.place.width > kMostPixels / layout.place.height)
    return;
  read_light_image(file, PixelEncoding::kOfFile);
}

void healpix(std::string_view bytes) {
  const auto file = input_file(bytes);
  for (const int column : {1, 2}) try {
      read_healpix(file, column);
    } catch (const InputError&) {
    }
}

constexpr std::size_t kHeaderBytes = 12, kChecksum = 16, kFileBytes = 24;  // places in the header

// Makes the checksum of a .sky file's header right.
std::string repaired_sky(std::string bytes) {
  std::uint32_t header = 0;
  if (bytes.size() < kFileBytes + sizeof(std::uint64_t)) return bytes;
  std::memcpy(&header, bytes.data() + kHeaderBytes, sizeof header);
  if (header > bytes.size()) return bytes;
  const std::uint64_t none = 0, length = bytes.size();
  std::memcpy(bytes.data() + kChecksum, &none, sizeof none);
  std::memcpy(bytes.data() + kFileBytes, &length, sizeof length);
  const std::uint64_t sum = checksum(std::string_view(bytes).substr(0, header));
  std::memcpy(bytes.data() + kChecksum, &sum, sizeof sum);
  return bytes;
}

void sky_file(std::string_view bytes) {
  const auto path = input_file(repaired_sky(std::string(bytes)), "input.sky");
  if (is_sky_file(path)) SkyFile(path).verify();
}

// Frames that a run finds in its folder: what they say of themselves, and their pixels.
void frame(std::string_view bytes) {
  const auto file = input_file(bytes, "input.exr");
  const WantedFrame wanted{"key", "title", "domemaster", 16, 16};
  check_frame(file, wanted);
  read_frame(file);
}

// ---- texts ----

// Show files, and the state of their first and last frames.
void show(std::string_view bytes) {
  try {
    const Show show = read_show(input_file(bytes, "show.yaml"));
    frame_state(show, 0);
    frame_state(show, frame_count(show) - 1);
  } catch (const TemporaryError&) {  // it names a file that is not there
  }
}

// Configurations of OpenColorIO are tried in a process of their own, which may crash.
void colour_config(std::string_view bytes) {
  try {
    Grader grader({.config = input_file(bytes, "config.ocio")});
  } catch (const TemporaryError&) {  // it names a file that is not there
  }
}

// Tables, with and without a header.
void table(std::string_view bytes) {
  const auto file = input_file(bytes);
  try {
    CsvFile table(file, {"a"});
    while (table.next()) {
      table.number("a", -1, 1);
      table.number("b", 0, 1e300);
      if (table.has("name")) table.text("name");
      table.required("a", -1, 1);
    }
  } catch (const InputError&) {
  }
  CsvFile table(file, '\t', {"a", "b"});
  while (table.next()) table.number("b");
}

// A target reads the bytes as a file of its kind.  It fails where an exception but InputError is not
// caught, where a sanitizer reports something, and where an input takes too much time or memory.
struct Target {
  std::string_view name;
  void (*run)(std::string_view bytes);
};
constexpr std::array kTargets{
    Target{"catalogue", catalogue}, Target{"colour_config", colour_config},
    Target{"frame", frame},         Target{"healpix", healpix},
    Target{"picture", picture},     Target{"show", show},
    Target{"sky_file", sky_file},   Target{"star_file", star_file},
    Target{"table", table}};

void (*chosen)(std::string_view) = nullptr;

}  // namespace
}  // namespace domefall

// libFuzzer calls these two: the first once, the second for each input.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** argv) {
  const std::string called = std::filesystem::path((*argv)[0]).filename();
  for (const auto& target : domefall::kTargets)
    if (called == "fuzz_" + std::string(target.name)) domefall::chosen = target.run;
  if (domefall::chosen) return 0;
  std::fprintf(stderr, "%s is the name of no target: see tests/fuzz/run\n", called.c_str());
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    domefall::chosen({reinterpret_cast<const char*>(data), size});
  } catch (const domefall::InputError&) {
  }
  return 0;
}
