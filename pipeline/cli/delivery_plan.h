// This file says what a delivery will hold, before any of it is written.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "pipeline/cli/delivery_run.h"
#include "pipeline/cli/graded_frames.h"
#include "pipeline/deliver/delivery.h"

namespace domefall {

// Returns the format of the delivered frames, which is the show's own with `bits` bits if these are
// given.  Throws InputError if they are more than the frames have.
GradedFormat delivered_format(const Show& show, std::optional<int> bits);

// Reads the sounds and the subtitles, and describes the delivery.  Throws InputError for names that
// are refused, for sounds that do not last as long as the frames, and for subtitles that last
// longer.  Also throws as GradedFrames.
Delivery describe_delivery(const DeliveryRun& run, const GradedFrames& frames,
                           const GradedFormat& format);

// Returns the path of frame k of the leader, counted from 0, below the delivery.
std::string leader_path(const Delivery& delivery, int k);

// Returns all files but the list of checksums.  Throws InputError if two would have the same name.
std::set<std::string> delivered_files(const Delivery& delivery);

}  // namespace domefall
