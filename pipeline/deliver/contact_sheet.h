// A contact sheet has small copies of many frames on one picture.
#pragma once

#include <string>
#include <vector>

#include "pipeline/image/frame_buffer.h"

namespace domefall {

// Returns a copy of at most `columns` by `rows` pixels with the sides' ratio kept.  Each pixel is
// the mean of the codes of those that it covers.  The picture itself is returned where it is no
// larger.
GradedFrame reduced_picture(const GradedFrame& picture, int columns, int rows);

// The largest pictures on a sheet are so wide and high.
inline constexpr int kSheetPicture = 256;

// Returns at most 36 frames, evenly spread over so many.
std::vector<int> frames_of_sheet(int count);

struct SheetPicture {
  GradedFrame picture;  // as reduced_picture() makes it, all of one size
  std::string label;
};

// Makes a sheet with six in a row, with the title above and a label below each.  There is at least
// one.  Throws as new_drawing() and Drawing::text.
GradedFrame contact_sheet(const std::string& title, const std::vector<SheetPicture>& pictures);

}  // namespace domefall
