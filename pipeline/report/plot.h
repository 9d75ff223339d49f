// A plot as data, and the one style that all of them are drawn in.
#pragma once

#include <string>
#include <vector>

namespace domefall {

struct PlotPoint {
  double x, y;
};

struct PlotCurve {
  // kPoints joins its points by lines, kArea fills a closed curve.
  enum class Style { kLine, kDashed, kDotted, kPoints, kArea };
  std::string name;  // a curve without one is not in the legend
  std::vector<PlotPoint> points;
  int colour = 0;  // in the palette, which repeats
  Style style = Style::kLine;
};

struct Axis {
  enum class Scale { kLinear, kLog, kOfPi };  // kOfPi is radians, marked in parts of pi
  std::string label;
  Scale scale = Scale::kLinear;
  double least = 0, most = 0;  // where they are equal, the data decide
  double mark_every = 0;       // in units of pi for kOfPi; 0 leaves it to gnuplot
};

struct PlotLabel {
  double x, y;
  std::string text;
};

// Text is UTF-8, with gnuplot's marks for indices and powers such as r_0 and 10^{-3}.
struct Plot {
  std::string title;
  Axis x, y;
  std::vector<PlotCurve> curves;
  std::vector<PlotLabel> labels;
  std::string legend = "top right";  // a place in gnuplot's words, or "below"; empty for none
};

// A plot with the name of its file, without a suffix.
struct NamedPlot {
  std::string name;
  Plot plot;
};

// The script by which gnuplot writes the plot to its standard output as SVG.  Points that are not
// finite, or not positive on a logarithmic axis, are left out.
std::string gnuplot_script(const Plot& plot);

// The plot as an SVG document.  Throws what run_gnuplot throws.
std::string draw(const Plot& plot);

}  // namespace domefall
