// This file says what a delivery will hold, before any of it is written.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "pipeline/render/frames/graded_frames.h"
#include "pipeline/theatre/delivery/delivery.h"
#include "pipeline/theatre/delivery/delivery_run.h"

namespace domefall {

// Returns the format of the delivered frames, which is the show's own with `bits` bits if these are
// given.  Throws InputError if they are more than the frames have.
GradedFormat delivered_format(const Show& show, std::optional<int> bits);

// Reads the subtitles, and describes the delivery.  Throws InputError for names that are refused
// and for subtitles that last longer than the frames.  Also throws as GradedFrames.
Delivery describe_delivery(const DeliveryRun& run, const GradedFrames& frames,
                           const GradedFormat& format);

// Returns the path of frame k of the leader, counted from 0, below the delivery.
std::string leader_path(const Delivery& delivery, int k);

// Returns all files but the list of checksums.  Throws InputError if two would have the same name.
std::set<std::string> delivered_files(const Delivery& delivery);

}  // namespace domefall
