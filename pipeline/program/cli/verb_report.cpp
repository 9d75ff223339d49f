#include <CLI/CLI.hpp>
#include <filesystem>
#include <system_error>

#include "pipeline/base/regular_file.h"
#include "pipeline/base/talk.h"
#include "pipeline/base/temporary_file.h"
#include "pipeline/program/cli/option_types.h"
#include "pipeline/program/cli/output_file.h"
#include "pipeline/program/cli/verbs.h"
#include "pipeline/report/report.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

void make_report_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw_file_error(folder, error.value());
  sweep_temporaries(folder);
}

void write_drawings(const std::vector<NamedPlot>& figures, const fs::path& folder) {
  make_report_folder(folder);
  for (const NamedPlot& figure : figures)
    write_output(folder / (figure.name + ".svg"), draw(figure.plot));
}

void report(const fs::path& out, bool quick, bool with_figures) {
  gnuplot_version();  // it throws without gnuplot, better before minutes of work than after
  make_report_folder(out);
  std::vector<NamedPlot> figures;
  if (with_figures) {
    figures = paper_curves();
    write_drawings(figures, out / "figures");
  }
  const Report measured =
      measure_report(quick, [](const std::string& what) { say("measuring " + what); });
  write_output(out / "rays.csv", csv_of(measured.rays));
  write_output(out / "positions.csv", csv_of(measured.positions));
  write_output(out / "frames.csv", csv_of(measured.frames));
  write_output(out / "orbits.csv", csv_of(measured.orbits));
  write_output(out / "costs.csv", csv_of(measured.costs));
  write_output(out / "benchmark.csv", csv_of(measured.costs.benchmark));
  const std::vector<NamedPlot> plots = error_plots(measured);
  write_drawings(plots, out / "plots");
  write_drawings(cost_plots(measured.costs), out / "plots");
  write_output(out / "accuracy.md", accuracy_page(measured, plots, figures));
  write_output(out / "costs.md", costs_page(measured));
  say((out / "accuracy.md").string());
}

}  // namespace

void add_report(CLI::App& app) {
  auto* verb = app.add_subcommand(
      "report", "Error and cost against run time and size, as tables, plots and pages about them");
  struct Options {
    std::string out;
    bool quick = false, figures = false;
  };
  auto options = std::make_shared<Options>();
  add_folder(*verb, "--out", options->out,
             "the folder for accuracy.md, costs.md, CSV files and plots/")
      ->required();
  verb->add_flag("--quick", options->quick, "few rays and frames: seconds instead of minutes");
  verb->add_flag("--figures", options->figures,
                 "the curves of the paper's figures as well, in figures/");
  verb->callback([options] { report(options->out, options->quick, options->figures); });
}

}  // namespace domefall
