// This file makes movies, either of finished frames out of a folder or of frames that are rendered
// for the movie.
#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/grade/grader.h"
#include "pipeline/show/show.h"
#include "pipeline/theatre/movie/movie_file.h"
#include "pipeline/theatre/movie/preset.h"

namespace domefall {

// Returns the plan of a preset's movie of some frames of a show, which follow one another.  Its
// subtitles are those of the first frame, and its tags are not filled in.  Throws, before a frame
// is made, for whatever would end the movie later: InputError where the preset takes no such
// frames, rate or sound, and as try_movie() and require_room().
MoviePlan plan_movie(const MoviePreset& preset, const Show& show, const std::vector<int>& frames,
                     Sound sound, const std::filesystem::path& out);

struct MovieRun {
  const Show& show;  // as large as its frames are
  std::vector<int> frames;
  const Grader& grader;  // of the show
  const MoviePlan& plan;
  std::filesystem::path out;
  int threads;  // at least 1
};

// Makes a movie of graded frames in a folder.  All are read and held against their keys and digests
// before ffmpeg is started, and each again when it is handed over.  Throws InputError if the show
// has no graded frames, or if some are good ones of another size, show or kind.  Throws
// TemporaryError, with the numbers of all frames that cannot be used, if some are missing, damaged
// or of another version of the show, and also if one is changed while the movie is made.  Also
// throws as MovieFile.
void movie_of_finished(const MovieRun& run, const std::filesystem::path& folder);

// Makes a movie of frames that are rendered and graded for it and written nowhere.  While ffmpeg
// takes one, the next is rendered.  Throws as KeyedRenderer and MovieFile.
void movie_of_rendered(const MovieRun& run);

}  // namespace domefall
