// A MovieFile is a movie in the making, by the program ffmpeg.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "pipeline/base/child_program.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/temporary_file.h"
#include "pipeline/image/encode/row_source.h"
#include "pipeline/theatre/movie/preset.h"
#include "pipeline/theatre/sound/sound.h"

namespace domefall {

struct MoviePlan {
  const MoviePreset& preset;
  std::string title;
  MovieSize frames;  // as they come
  FrameRate rate;
  int first = 0, count = 0;  // of the show's frames
  ColourTags tags;
  Sound sound;
  std::string subtitles;                        // the text of burn_in.h, or empty
  std::string chapters{};                       // as ffmetadata, or empty
  std::optional<LightLevels> levels{};          // of HDR frames that were there to be measured
  std::optional<MasteringDisplay> mastering{};  // of HDR frames
};

// Makes a movie of one small black frame and the first sound, as the whole would be made, and
// throws it away.  So what is missing shows before any frame is made.  This takes some 0.2 s.
// Throws TemporaryError if ffmpeg, ffprobe or (for a preset that needs it) mkvmerge is not there,
// or if they cannot make such a movie.  Throws InputError if they can, but not with this sound.
void try_movie(const MoviePlan& plan);

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

  // Ends the movie, asks ffprobe how many frames it has, flushes it and gives it its name.  A movie
  // that was begun with kLevelsToCome gets its light levels first.  Throws as above, and as
  // TemporaryFile.
  void finish(const std::optional<LightLevels>& levels = {});

 private:
  // Returns the descriptor of the file that ffmpeg writes.
  int by_ffmpeg() const { return flat_ ? flat_->descriptor() : file_.descriptor(); }
  [[noreturn]] void fail(const ChildOutcome& outcome) const;
  void put_levels(const LightLevels& levels) const;
  void count_frames(const ChildOutcome& made) const;

  std::filesystem::path path_;
  int count_, added_ = 0;
  FrameRate rate_;
  TemporaryFile file_;
  std::optional<TemporaryFile> flat_;                 // before a player knows that it is a sphere
  std::unique_ptr<MemoryFile> subtitles_, chapters_;  // none where the movie has none
  std::unique_ptr<ChildProgram> ffmpeg_;
};

// Returns the sound that a show names as a browser plays it: mixed to stereo by ffmpeg, as AAC in an
// MP4 file of the show's length.  Throws InputError for a show that names none and as show_sound(),
// and TemporaryError where ffmpeg fails.
std::string sound_for_browser(const Show& show);

}  // namespace domefall
