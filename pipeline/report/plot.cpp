#include "pipeline/report/plot.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "pipeline/base/child_program.h"

namespace domefall {
namespace {

// These are Okabe and Ito's colours, which colour-blind readers can tell apart too.
constexpr std::array kPalette{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                              "#e69f00", "#56b4e9", "#000000"};

const char* colour(int index) {
  return kPalette[static_cast<std::size_t>(index) % kPalette.size()];
}

// Border 3 is the sum of 1 (the bottom) and 2 (the left side).  `clip one` also draws the segments
// of which only one end lies within the axes' ranges.
constexpr const char* kStyle = R"(set encoding utf8
set terminal svg size 960,640 dynamic enhanced font "sans-serif,17" linewidth 1.4 background "#ffffff"
set border 3 linewidth 0.8 linecolor rgb "#444444"
set tics nomirror out textcolor rgb "#222222"
set grid linewidth 0.5 linecolor rgb "#dddddd"
set clip one
)";

// Returns a number for a script.  Ten digits are far finer than a line is wide.
std::string plot_number(double value) { return fmt::format("{:.10g}", value); }

// Returns a string in single quotes, in which gnuplot runs no command between backquotes, knows no
// escapes, and takes two quotes for one.  A string cannot go beyond its line.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += c;
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out + "'";
}

// Writes a multiple of pi as a reduced fraction: 1.5 becomes 3π/2.
std::string parts_of_pi(double part) {
  if (part == 0) return "0";
  constexpr double kFinest = 4;  // the finest fractions are quarters
  int above = static_cast<int>(std::lround(std::abs(part) * kFinest)), below = 4;
  while (below > 1 && above % 2 == 0) above /= 2, below /= 2;
  std::string text = part < 0 ? "−" : "";
  if (above != 1) text += fmt::to_string(above);
  text += "π";
  return below > 1 ? fmt::format("{}/{}", text, below) : text;
}

// A mark at an end of the axis stays on it by kSlack, whichever way the quotient is rounded.
std::string marks_of_pi(const Axis& axis) {
  constexpr double kPi = std::numbers::pi, kSlack = 1e-9;
  std::string marks;
  const int first = static_cast<int>(std::ceil(axis.least / kPi / axis.mark_every - kSlack));
  const int last = static_cast<int>(std::floor(axis.most / kPi / axis.mark_every + kSlack));
  for (int k = first; k <= last; ++k)
    marks +=
        fmt::format("{}{} {}", marks.empty() ? "" : ", ", quoted(parts_of_pi(k * axis.mark_every)),
                    plot_number(k * axis.mark_every * kPi));
  return marks;
}

// Returns the lines of the script for one axis, which is named x or y.  "10^{%L}" writes a mark of
// a logarithmic axis as a power of ten.
std::string axis_script(const char* name, const Axis& axis) {
  std::string script = fmt::format("set {}label {}\n", name, quoted(axis.label));
  if (axis.most > axis.least)
    script +=
        fmt::format("set {}range [{}:{}]\n", name, plot_number(axis.least), plot_number(axis.most));
  if (axis.scale == Axis::Scale::kLog)
    script += fmt::format("set logscale {0}\nset format {0} \"10^{{%L}}\"\n", name);
  if (axis.scale == Axis::Scale::kOfPi)
    script += fmt::format("set {}tics ({})\n", name, marks_of_pi(axis));
  else if (axis.mark_every > 0)
    script += fmt::format("set {}tics {}\n", name, plot_number(axis.mark_every));
  return script;
}

bool can_be_drawn(const Axis& axis, double value) {
  return std::isfinite(value) && (axis.scale != Axis::Scale::kLog || value > 0);
}

// Returns a named block of data, $c0 and so on, which lets one script hold all its curves.
std::string data_block(const Plot& plot, const PlotCurve& curve, const std::string& name) {
  std::string block = name + " << EOD\n";
  for (const PlotPoint& p : curve.points)
    if (can_be_drawn(plot.x, p.x) && can_be_drawn(plot.y, p.y))
      block += fmt::format("{} {}\n", plot_number(p.x), plot_number(p.y));
  return block + "EOD\n";
}

// Returns how a curve is drawn, in gnuplot's words.  The types of its points follow its colours, so
// that curves can also be told apart without colour.
std::string drawn_with(const PlotCurve& curve) {
  const std::string in = " linecolor rgb " + quoted(colour(curve.colour));
  switch (curve.style) {
    case PlotCurve::Style::kDashed:
      return "with lines linewidth 1.5 dashtype (9,6)" + in;
    case PlotCurve::Style::kDotted:
      return "with lines linewidth 1 dashtype (2,4)" + in;
    case PlotCurve::Style::kPoints:
      return fmt::format("with linespoints linewidth 1.5 pointsize 0.7 pointtype {}{}",
                         4 + curve.colour % 10, in);
    case PlotCurve::Style::kArea:
      return "with filledcurves closed fillstyle solid 0.15 noborder" + in;
    case PlotCurve::Style::kLine:
      break;
  }
  return "with lines linewidth 2" + in;
}

std::string key_script(const std::string& place) {
  if (place.empty()) return "unset key\n";
  // gnuplot's own "below" would run into the label of the axis, so a wider margin is made for it.
  if (place == "below")
    return "set bmargin 9.5\nset key at screen 0.98,0.03 right bottom maxrows 4\n";
  return "set key " + place + " opaque\n";
}

// Runs gnuplot and returns what it writes to standard output.
std::string gnuplot(const std::string& option, const std::string& script) {
  ChildProgram program({"gnuplot", option}, {}, "gnuplot-nox");
  program.write(script.data(), script.size());
  const ChildOutcome outcome = program.wait();
  if (!outcome.good()) throw std::runtime_error("gnuplot " + outcome.text());
  if (program.output().empty() || program.output_bytes() > program.output().size())
    throw std::runtime_error("gnuplot: nothing was drawn, or too much");
  return program.output();
}

}  // namespace

std::string gnuplot_script(const Plot& plot) {
  std::string script = fmt::format("{}set title {}\n", kStyle, quoted(plot.title));
  script += axis_script("x", plot.x) + axis_script("y", plot.y);
  script += key_script(plot.legend);
  for (const PlotLabel& label : plot.labels)
    script += fmt::format("set label {} at {},{} center front\n", quoted(label.text),
                          plot_number(label.x), plot_number(label.y));
  std::string curves;
  int index = 0;
  for (const PlotCurve& curve : plot.curves) {
    const std::string name = fmt::format("$c{}", index++);
    script += data_block(plot, curve, name);
    curves +=
        fmt::format("{}{} using 1:2 {} {}", curves.empty() ? "" : ", ", name, drawn_with(curve),
                    curve.name.empty() ? "notitle" : "title " + quoted(curve.name));
  }
  return fmt::format("{}plot {}\n", script, curves);
}

std::string draw(const Plot& plot) { return run_gnuplot(gnuplot_script(plot)); }

std::string gnuplot_version() {
  const std::string said = gnuplot("--version", "");
  return said.substr(0, said.find('\n'));
}

std::string run_gnuplot(const std::string& script) { return gnuplot("-", script); }

}  // namespace domefall
