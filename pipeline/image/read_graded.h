// This file reads finished graded frames back.
#pragma once

#include <filesystem>

#include "pipeline/image/frame_buffer.h"
#include "pipeline/image/frame_check.h"

namespace domefall {

// Reads a graded frame into `frame`, 8 bits being spread to 16, if it is good (check_frame).
// Otherwise it only says what is wrong.  The file is read once, into memory, and the bytes that are
// decoded are those whose digest was right.  Throws as FileBytes, TemporaryError where there is no
// memory for them, and std::runtime_error, naming the file, if they cannot be decoded.
FrameCondition read_graded(const std::filesystem::path& path, const WantedFrame& wanted,
                           GradedFrame& frame);

}  // namespace domefall
