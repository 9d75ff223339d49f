// A Plot is one figure of the report as data: axes, curves and labels.  All plots are drawn in one
// style.
#pragma once

#include <string>
#include <vector>

namespace domefall {

struct PlotPoint {
  double x, y;
};

struct PlotCurve {
  // kPoints marks its points and joins them by lines.  kArea fills a closed curve.
  enum class Style { kLine, kDashed, kDotted, kPoints, kArea };
  std::string name;  // a curve without one is not in the legend
  std::vector<PlotPoint> points;
  int colour = 0;  // index into the palette, which repeats
  Style style = Style::kLine;
};

struct Axis {
  enum class Scale { kLinear, kLog, kOfPi };  // kOfPi: radians, marked in parts of pi
  std::string label;
  Scale scale = Scale::kLinear;
  double least = 0, most = 0;  // the range; if both are equal, gnuplot fits it to the data
  double mark_every = 0;       // in units of pi for kOfPi; 0 leaves it to gnuplot
};

struct PlotLabel {
  double x, y;
  std::string text;
};

// Text is UTF-8, with gnuplot's marks for indices and powers such as r_0 and 10^{-3}.
struct Plot {
  std::string title{};
  Axis x, y;
  std::vector<PlotCurve> curves{};
  std::vector<PlotLabel> labels{};
  std::string legend = "top right";  // a place in gnuplot's words, or "below"; empty for none
};

// A NamedPlot is a plot with the name of its file, which has no suffix here.
struct NamedPlot {
  std::string name;
  Plot plot;
};

// Returns the script by which gnuplot writes the plot to its standard output as SVG.  The script
// leaves out points that are not finite, or not positive on a logarithmic axis.
std::string gnuplot_script(const Plot& plot);

// Returns the plot as an SVG document.  Throws what run_gnuplot throws.
std::string draw(const Plot& plot);

// Returns gnuplot's name and version, for example "gnuplot 5.4 patchlevel 4".  Throws as
// run_gnuplot().
std::string gnuplot_version();

// Returns what gnuplot, a program of its own, writes to its standard output.  Throws TemporaryError if
// it cannot be started, and std::runtime_error with its message if the script is faulty or draws nothing.
std::string run_gnuplot(const std::string& script);

}  // namespace domefall
