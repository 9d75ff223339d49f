// Stiff and extreme cases: what a ray or a frame does where something diverges, cancels or
// degenerates, and the bound that its error must keep there.  The tests hold every case to its
// bound, and docs/accuracy.md shows the same list.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace domefall {

struct ExtremeResult {
  double worst;         // of the case's quantity; a value that is not finite is a failure
  std::string outcome;  // what happens there, in words and numbers
};

struct ExtremeCase {
  std::string name;      // CamelCase, as in the tests
  std::string tried;     // what is tried
  std::string quantity;  // what `worst` is
  double bound;          // of `worst`
  std::function<ExtremeResult()> measure;
};

// The azimuth of rays against the 100-digit reference.
std::vector<ExtremeCase> extreme_rays();
// Images of stars by the tables, against limits in closed form and the exact integral.  All rays
// and images together take about 2 s.
std::vector<ExtremeCase> extreme_images();
// Frames of 96 pixels with every sky and stars, whose pixels must be finite.  measure() throws
// InputError if the shipped catalogue cannot be read.
std::vector<ExtremeCase> extreme_frames();
// Frames of that size whose light or whose places are known.  All frames together take about 3 s.
std::vector<ExtremeCase> extreme_frame_errors();

// All cases as a table in Markdown: what is tried, what happens, quantity, worst, bound.
std::string extreme_table();

}  // namespace domefall
