// Stiff and extreme cases, measured: what happens to a ray or a frame where something diverges,
// cancels or degenerates, and the bound that it must keep.  The tests hold every case to its bound;
// docs/accuracy.md shows the same list.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace domefall {

struct ExtremeResult {
  double worst;         // of the case's quantity; not finite: a failure of its own
  std::string outcome;  // what happens there, in words and numbers
};

struct ExtremeCase {
  std::string name;      // CamelCase, as in the tests
  std::string tried;     // what is tried
  std::string quantity;  // what `worst` is
  double bound;
  std::function<ExtremeResult()> measure;
};

// Rays, against the 100-digit reference.  About 2 s in all.
std::vector<ExtremeCase> extreme_rays();
// Frames of 96 pixels, every sky lit and with stars.  About 3 s in all.  measure() throws InputError if
// the shipped catalogue cannot be read.
std::vector<ExtremeCase> extreme_frames();

// As a table in Markdown: what is tried, what happens, quantity, worst, bound.
std::string extreme_table();

}  // namespace domefall
