// The timeline of a show as files that editors read: OpenTimelineIO, a list of markers for DaVinci
// Resolve, subtitles (docs/timeline.md).
#pragma once

#include <string>

#include "pipeline/render/frames/frame_folder.h"
#include "pipeline/show/show.h"

namespace domefall {

// Returns a Timeline.1 of OpenTimelineIO's JSON: one track with a clip for each segment, its
// dissolves as transitions, and the markers.  Clips refer to the frames in `folder`, graded ones
// where the show makes any.
std::string otio_text(const Show& show, const FrameFolder& folder);

// Returns the markers as a CMX 3600 list with the comments by which Resolve knows them.  Its times
// begin with 01:00:00:00, as its timelines do, and count whole frames without dropping any.
std::string marker_list(const Show& show);

enum class SubtitleKind { kWebVtt, kSubRip };
// Returns the titles of the show and of its segments, in the order of their beginnings, whether the
// show draws them or not.  Counters have their values in the first frame of a title.
std::string subtitles(const Show& show, SubtitleKind kind);

}  // namespace domefall
