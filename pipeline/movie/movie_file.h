// A MovieFile is a movie in the making, by the program ffmpeg.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "pipeline/image/descriptor.h"
#include "pipeline/image/encode/row_source.h"
#include "pipeline/image/memory_file.h"
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

// Makes a movie of one small black frame and throws it away.  So an ffmpeg that lacks something
// says so before any frame is made.  Asks for mkvmerge if the preset needs it.  This takes 0.1 s.
// Throws TemporaryError if either program is missing or ffmpeg cannot make such a movie.
void try_ffmpeg(const MoviePlan& plan);

// Frames go through a pipe, and the file appears under its name when it is whole
// (temporary_file.h).  A movie of the whole sphere is written twice, by ffmpeg, which cannot say
// that it is one, and by mkvmerge, which can.
class MovieFile {
 public:
  // Starts ffmpeg.  Throws as TemporaryFile and ChildProgram.
  MovieFile(const std::filesystem::path& path, const MoviePlan& plan);

  // Adds the next frame.  Throws what its rows throw.  If ffmpeg has ended, throws TemporaryError
  // where it was killed or names an error of the disk or of memory, and else std::runtime_error.
  // Both say what it said last.
  void add(const RowPicture& frame);

  // Ends the movie, asks ffprobe how many frames it has, flushes it and gives it its name.  Throws
  // as above, and as TemporaryFile.
  void finish();

 private:
  // Returns the descriptor of the file that ffmpeg writes.
  int by_ffmpeg() const { return flat_ ? flat_->descriptor() : file_.descriptor(); }
  void wrap_around() const;
  [[noreturn]] void fail(const ChildOutcome& outcome) const;
  void count_frames(const ChildOutcome& made) const;

  std::filesystem::path path_;
  int count_, added_ = 0;
  FrameRate rate_;
  std::string title_;
  TemporaryFile file_;
  std::optional<TemporaryFile> flat_;      // before a player knows that it is a sphere
  std::unique_ptr<MemoryFile> subtitles_;  // none where the movie has none
  std::unique_ptr<ChildProgram> ffmpeg_;
};

}  // namespace domefall
