// The sound of a show as a browser plays it.
#pragma once

#include <string>

#include "pipeline/show/show.h"

namespace domefall {

// Returns the sound that a show names, mixed to stereo by ffmpeg, as AAC in an MP4 file of the
// show's length.  Throws InputError for a show that names none and as show_sound(), and
// TemporaryError where ffmpeg fails.
std::string sound_for_browser(const Show& show);

}  // namespace domefall
