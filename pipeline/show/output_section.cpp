#include "pipeline/show/output_section.h"

#include <fmt/format.h>

namespace domefall {
namespace {

// Returns the format of the graded files, or nothing if there are to be none.
std::optional<GradedFormat> read_graded_format(const Section& s) {
  enum class Word { kNone, kPng16, kPng8, kJpeg, kTiff16, kTiff8 };
  using enum Word;
  // The words png and tiff come from earlier versions, which did not know the numbers of bits, and
  // mean 16 bits.
  const Word word = s.word<Word>("graded", {{"png16", kPng16},
                                            {"png8", kPng8},
                                            {"jpeg", kJpeg},
                                            {"tiff16", kTiff16},
                                            {"tiff8", kTiff8},
                                            {"png", kPng16},
                                            {"tiff", kTiff16},
                                            {"none", kNone}})
                        .value_or(kPng16);
  switch (word) {
    case kPng16:
      return GradedFormat{GradedKind::kPng16};
    case kPng8:
      return GradedFormat{GradedKind::kPng8};
    case kJpeg:
      return GradedFormat{GradedKind::kJpeg};
    case kTiff16:
      return GradedFormat{GradedKind::kTiff16};
    case kTiff8:
      return GradedFormat{GradedKind::kTiff8};
    case kNone:
      break;
  }
  return std::nullopt;
}

// Reads the quality, which only JPEGs have.
void read_quality(const Section& s, std::optional<GradedFormat>& graded) {
  const Item* item = s.find("quality");
  if (!item) return;
  const auto quality = read_whole_number(*item, kPureNumber.within(1, 100));
  // The kinds without loss have no quality to choose.
  if (!graded || graded->kind != GradedKind::kJpeg)
    item->fail("is that of a JPEG; say graded: jpeg, or leave it out");
  else if (quality)
    graded->quality = *quality;
}

// Reads the format of the scene-linear files, or returns nothing if there are to be none.
std::optional<ExrFormat> read_linear(const Section& s) {
  using enum ExrCompression;
  enum class Word { kNone, kHalf, kFloat };
  const auto compression = s.word<ExrCompression>(
      "compression", {{"zip", kZip}, {"zips", kZips}, {"piz", kPiz}, {"none", kNone}});
  const Word word =
      s.word<Word>("linear",
                   {{"half", Word::kHalf}, {"float", Word::kFloat}, {"none", Word::kNone}})
          .value_or(Word::kHalf);
  // A compression that is not given is zip, which keeps all bits as the others do.
  if (word != Word::kNone)
    return ExrFormat{word == Word::kFloat ? ExrPixels::kFloat : ExrPixels::kHalf,
                     compression.value_or(kZip)};
  if (const Item* item = s.find("compression"))
    item->fail("is that of scene-linear files, of which linear: none makes none; leave it out");
  return std::nullopt;
}

// Reads the name that the files of frames begin with, which must name a visible file and no folder.
void read_name(const Section& s, FrameNames& names) {
  const Item* item = s.find("name");
  const auto name = item ? read_text(*item) : std::nullopt;
  if (!name) return;
  constexpr std::size_t kLongest = 200;  // bytes; file systems take 255 with number and kind
  // A folder in the name would be another place than the one that --out names.
  if (name->find('/') != std::string::npos)
    item->fail("is that of a file and may have no '/'; --out names the folder");
  else if (name->starts_with('.'))
    item->fail("may not begin with a dot, which hides files");
  else if (name->size() > kLongest)
    item->fail(fmt::format("may have {} bytes, got {}", kLongest, name->size()));
  else
    names.name = *name;
}

// Reads how the files of frames are called.  A key in error leaves its default.
FrameNames read_names(const Section& s) {
  FrameNames names;
  read_name(s, names);
  const auto number = [&s](const char* key, double low, double high, int& into) {
    if (const Item* item = s.find(key))
      into = read_whole_number(*item, kPureNumber.within(low, high)).value_or(into);
  };
  // The number of the last frame, at most kLargestStart + kMostFrames, fits an int, whose largest
  // value has ten digits.
  constexpr double kLargestStart = 1'000'000'000, kMostDigits = 10, kMostInFolder = 10'000;
  number("start", 0, kLargestStart, names.start);
  number("digits", 1, kMostDigits, names.digits);
  number("per_folder", 1, kMostInFolder, names.per_folder);
  return names;
}

}  // namespace

Output read_output(const Section& show) {
  const Section s = subsection(show, "output",
                               {"linear", "compression", "graded", "quality", "name", "start",
                                "digits", "per_folder", "owner"});
  Output output;
  output.linear = read_linear(s);
  output.graded = read_graded_format(s);
  read_quality(s, output.graded);
  output.names = read_names(s);
  if (const Item* item = s.find("owner")) output.owner = read_text(*item).value_or("");
  // Both are missing only where both keys say none, so that `graded` is there to be blamed.
  if (!output.linear && !output.graded)
    s.find("graded")->fail("and linear are both none, so that nothing would be made");
  return output;
}

}  // namespace domefall
