// An extreme case is a set of rays, images or frames where something diverges, cancels or
// degenerates, with a bound on the error there.  The tests hold every case to its bound, and
// docs/accuracy.md shows the same list.
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

// Returns the cases that compare the azimuth of rays with the 100-digit reference, and images of
// stars, as the tables give them, with limits in closed form and with the exact integral.  They take
// about 2 s.
std::vector<ExtremeCase> extreme_rays();
// Returns such cases near charges and in wormholes.
std::vector<ExtremeCase> extreme_swept();
// Returns such cases about spins, by their exact rays.
std::vector<ExtremeCase> extreme_spins();
// Returns the cases of frames of 96 pixels with every sky and stars, whose pixels must be finite, or
// in which the light or the places are known.  They take about 3 s.  measure() throws InputError if
// the shipped catalogue cannot be read.
std::vector<ExtremeCase> extreme_frames();

// Measures all cases and returns them as a table in Markdown.  Its columns are the name, what is
// tried, what happens, the worst value, its quantity and its bound.
std::string extreme_table();

}  // namespace domefall
