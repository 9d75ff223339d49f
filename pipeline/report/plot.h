// A plot as data, and the one style that all of them are drawn in.
#pragma once

#include <string>
#include <vector>

namespace domefall {

struct PlotPoint {
  double x, y;
};

struct Curve {
  enum class Style { kLine, kDashed, kDotted, kPoints, kArea };  // kPoints: joined; kArea: closed
  std::string name;                                              // empty: not in the legend
  std::vector<PlotPoint> points;
  int colour = 0;  // of the palette, any number
  Style style = Style::kLine;
};

struct Axis {
  enum class Scale { kLinear, kLog, kOfPi };  // kOfPi: radians, marked in parts of pi
  std::string label;
  Scale scale = Scale::kLinear;
  double least = 0, most = 0;  // equal: from the data
  double mark_every = 0;       // 0: as the plotter likes; kOfPi: in units of pi
};

struct PlotLabel {
  double x, y;
  std::string text;
};

// Text is UTF-8 with gnuplot's marks for indices and powers: r_0, 10^{-3}.
struct Plot {
  std::string title;
  Axis x, y;
  std::vector<Curve> curves;
  std::vector<PlotLabel> labels;
  std::string legend = "top right";  // a place as gnuplot calls it, or below; empty: none
};

// A plot with the name of its file, without a suffix.
struct NamedPlot {
  std::string name;
  Plot plot;
};

// What gnuplot needs to write the plot to its standard output as SVG.  Points that are not finite,
// or not positive on a logarithmic axis, are left out.
std::string gnuplot_script(const Plot& plot);

// The plot as an SVG document.  Throws as run_gnuplot.
std::string draw(const Plot& plot);

}  // namespace domefall
