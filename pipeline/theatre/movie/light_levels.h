// The light levels of a movie for HDR, by which a screen fits what is brighter than it can show.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "pipeline/grade/grader.h"
#include "pipeline/image/frame_buffer.h"

namespace domefall {

// CTA-861.3, Annex P: of each pixel the largest channel counts, in cd/m^2.
struct LightLevels {
  double content = 0;        // MaxCLL: the brightest pixel of all frames
  double frame_average = 0;  // MaxFALL: the largest mean of a frame, corners of a dome and all
};

// FrameLevels are those of one frame of PQ codes, whose rows come in any order.
class FrameLevels {
 public:
  FrameLevels(int width, int height);

  // Takes the rows first <= row < end, each once.  Any number of threads may do so.
  void take(int first, int end, const unsigned short* rgb);
  // Takes the frame into the levels of its movie.
  void add_to(LightLevels& levels) const;

 private:
  struct Row {
    double sum = 0;
    unsigned short brightest = 0;
  };
  std::size_t width_;
  std::vector<Row> rows_;
};

// A MasteringDisplay is the screen that a grade is made for, as SMPTE ST 2086 describes it.
struct MasteringDisplay {
  std::array<double, 8> xy{};  // CIE x, y of red, green, blue and white
  double peak = 0;             // cd/m^2
};

// Returns the screen of a grade in PQ, or nothing for another.  Its peak is the light of what is
// brightest in the grade's view, to whole cd/m^2, and its primaries are those of the codes.
std::optional<MasteringDisplay> mastering_display(const Grader& grader);

}  // namespace domefall
