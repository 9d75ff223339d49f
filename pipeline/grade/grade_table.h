// A grade as a table, which is several times as quick as to follow its formulas for each pixel.
//
// A pixel is split into its largest channel M, the ratio of its least channel to M, which is how
// grey it is, and the place of the third between the two, which is a hue; for each of the six
// orders of the channels, so that what a view does at M, at the least channel or at the grey axis
// is no kink within a cell.  M is a half float, and there is a node at each 32nd of its bits'
// steps, 32 to the octave; the ratio has 21 nodes, even in its square root, from 0.25 to 1, and the
// hue 9.  Codes are interpolated by parabolas in ratio and hue and linearly in M.
//
// When the table is made, each of its cells is compared with the formulas at five places.  One that
// errs by more than 0.8 kMostError there is left out with its neighbours, and so are ratios below
// 0.25, negative values and what is no number.  Those pixels are for the caller to grade by the
// formulas.
#pragma once

#include <Imath/half.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace domefall {

class GradeTable {
 public:
  // Half a step of a 12-bit display, as a part of white.
  static constexpr double kMostError = 0.5 / 4095;

  // Grades pixels of three floats to codes from 0 to 1.  Several threads call it at once.
  using Formulas = std::function<void(const float* rgb, int pixels, float* codes)>;

  // Takes 0.5 s of processor time, on as many threads as there are processors, and 19 MB.
  explicit GradeTable(const Formulas& formulas);

  // Grades pixels to 16 bits, and writes the numbers of those that it does not hold, in ascending
  // order, to missed[].  Returns how many those are; their codes are not set.  `count` is at most
  // kMostPixels.  out[] has room for one value more, which is overwritten.
  static constexpr int kMostPixels = 512;
  int look_up(const Imath::half* rgb, int count, unsigned short* out, int* missed) const;

  // The largest error found in the cells that are held, as a part of white, and the part of all
  // cells that is held.
  double error() const { return error_; }
  double held() const { return held_; }

 private:
  struct Fill;
  // Decides, by the errors of all cells, which are held.
  void hold(const std::vector<float>& errors);

  std::vector<float> nodes_;         // of four floats: 65535 times the codes, plus 0.5 to round; 0
  std::vector<std::uint8_t> holds_;  // one for each cell
  double error_ = 0, held_ = 0;
};

}  // namespace domefall
