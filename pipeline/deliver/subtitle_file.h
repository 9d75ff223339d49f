// This file reads subtitles in SubRip's format (.srt).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace domefall {

struct SubtitleFile {
  int count = 0;
  double end_s = 0;  // when the last one goes
};

// Reads the times of a text, which has lines of "00:00:01,000 --> 00:00:04,000".  Throws InputError
// if there is none.  Throws it with the number of the line if a time is wrong or a subtitle does
// not end after it begins.
SubtitleFile parse_subtitles(std::string_view text);

// Does the same for a file, whose name stands before the message.  Throws as RegularFile too.
SubtitleFile read_subtitle_file(const std::filesystem::path& path);

}  // namespace domefall
