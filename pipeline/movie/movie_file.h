// A movie in the making, by the program ffmpeg.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "pipeline/image/descriptor.h"
#include "pipeline/image/encode/row_source.h"
#include "pipeline/image/temporary_file.h"
#include "pipeline/movie/child_program.h"
#include "pipeline/movie/preset.h"
#include "pipeline/movie/sound.h"

namespace domefall {

struct MoviePlan {
  const MoviePreset& preset;
  std::string title;
  MovieSize frames;  // as they come
  FrameRate rate;
  int first = 0, count = 0;  // of the show's frames
  ColourTags tags;
  Sound sound;
  std::string subtitles;  // the text of burn_in.h, or empty
};

// Makes a movie of one small black frame, which goes nowhere, so that an ffmpeg that lacks
// something says so before any frame is made.  Takes 0.1 s.  Throws TemporaryError without ffmpeg
// and where it cannot make such a movie.
void try_ffmpeg(const MoviePlan& plan);

// Frames go through a pipe, and the file appears under its name when it is whole
// (temporary_file.h).
class MovieFile {
 public:
  // Starts ffmpeg.  Throws as TemporaryFile and ChildProgram.
  MovieFile(const std::filesystem::path& path, const MoviePlan& plan);

  // Adds the next frame.  Throws what its rows throw, and if ffmpeg has ended: TemporaryError where
  // it was killed or names an error of the disk or of memory, and else std::runtime_error; both say
  // what it said last.
  void add(const RowPicture& frame);

  // Ends the movie, asks ffprobe how many frames it has, flushes it and gives it its name.  Throws
  // as above, and as TemporaryFile.
  void finish();

 private:
  [[noreturn]] void fail(const ChildOutcome& outcome) const;
  void count_frames(const ChildOutcome& made) const;

  std::filesystem::path path_;
  int count_, added_ = 0;
  TemporaryFile file_;
  Descriptor subtitles_;
  std::unique_ptr<ChildProgram> ffmpeg_;
};

}  // namespace domefall
