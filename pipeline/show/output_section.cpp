#include "pipeline/show/output_section.h"

namespace domefall {
namespace {

std::optional<GradedFormat> read_graded(const Section& s) {
  enum class Word { kNone, kPng16, kPng8, kJpeg, kTiff16, kTiff8 };
  using enum Word;
  // Without their bits, which earlier versions did not know, they are of 16.
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

}  // namespace

Output read_output(const Section& show) {
  const Section s = subsection(show, "output", {"graded", "quality"});
  Output output;
  output.graded = read_graded(s);
  if (const Item* item = s.find("quality")) {
    const auto quality = read_whole_number(*item, kPureNumber.within(1, 100));
    if (!output.graded || output.graded->kind != GradedKind::kJpeg)
      item->fail("is that of a JPEG; say graded: jpeg, or leave it out");
    else if (quality)
      output.graded->quality = *quality;
  }
  return output;
}

}  // namespace domefall
