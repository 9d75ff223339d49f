// A contact sheet has small copies of many frames on one picture.
#pragma once

#include <string>
#include <vector>

#include "pipeline/image/frame_buffer.h"
#include "pipeline/render/frames/graded_frames.h"
#include "projections/projection.h"

namespace domefall {

// Returns a copy of at most `columns` by `rows` square pixels that looks like a picture whose pixels
// have these sides.  Each pixel is the mean of the codes of those that it covers.  A picture of
// square pixels that is no larger is returned as it is.
GradedFrame reduced_picture(const GradedFrame& picture, int columns, int rows,
                            const ScreenSides& pixel = {1, 1});

// A picture on a sheet has at most this many columns and rows.
inline constexpr int kSheetPicture = 256;

inline constexpr int kMostOnSheet = 36;

// Returns at most kMostOnSheet of `count` frames, evenly spread.
std::vector<int> frames_of_sheet(int count);

struct SheetPicture {
  GradedFrame picture;  // as reduced_picture() makes it, all of one size
  std::string label;
};

// Makes a sheet with at most six pictures in a row, the title above all and a label below each.
// There must be at least one picture.  Throws as Drawing and Drawing::text.
GradedFrame contact_sheet(const std::string& title, const std::vector<SheetPicture>& pictures);

// Returns a sheet of these frames with a label each.  They are read on several threads.  Throws as
// GradedFrames::read().
GradedFrame sheet_of_frames(const GradedFrames& from, const Show& show,
                            const std::vector<int>& frames, const std::vector<std::string>& labels,
                            int threads);

}  // namespace domefall
