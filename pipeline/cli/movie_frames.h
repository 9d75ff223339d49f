// This file makes movies, either of finished frames out of a folder or of frames that are rendered
// for the movie.
#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/grade/grader.h"
#include "pipeline/movie/movie_file.h"
#include "pipeline/movie/preset.h"
#include "pipeline/show/show.h"

namespace domefall {

// Returns the size of a preset's movie of frames that have this projection.  Throws InputError
// where the preset takes no such frames.
MovieSize movie_size_of(const MoviePreset& preset, const Projection& frames);

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
