// This file reads subtitles in SubRip's format (.srt).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace domefall {

struct SubtitleFile {
  int count = 0;
  double end_s = 0;                // when the last one goes
  std::vector<std::string> notes;  // what is odd about it, one line each, without the file's name
  std::string converted;           // the text in UTF-8, where the file has another encoding
};

// Reads the times of a text in UTF-8, which has lines of "00:00:01,000 --> 00:00:04,000", with a
// comma or a point, up to three digits of a fraction or none, and any end of line.  Such a line
// stands behind an empty one or the number of the subtitle; spoken text may have an arrow in it.
// Throws InputError if there is none.  Throws it with the number of the line if a time is wrong, a
// subtitle does not end after it begins, or the text is not UTF-8.
SubtitleFile parse_subtitles(std::string_view text);

// Does the same for a file, in UTF-8 or UTF-16, whose name stands before the message.  Throws as
// RegularFile too.
SubtitleFile read_subtitle_file(const std::filesystem::path& path);

}  // namespace domefall
