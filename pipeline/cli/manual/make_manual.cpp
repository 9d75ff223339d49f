#include "pipeline/cli/manual/make_manual.h"

#include <fstream>
#include <stdexcept>

#include "pipeline/cli/manual/bash_completion.h"
#include "pipeline/cli/manual/described_option.h"
#include "pipeline/cli/manual/man_page.h"
#include "pipeline/cli/verbs.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

void write_page(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace

void make_manual(const std::string& date, const fs::path& folder) {
  const auto program = describe_command_line();
  fs::create_directories(folder / "man1");
  write_page(folder / "man1" / "domefall.1", program_page(*program, date));
  for (const CLI::App* verb : verbs_of(*program))
    write_page(folder / "man1" / ("domefall-" + verb->get_name() + ".1"), verb_page(*verb, date));
  fs::create_directories(folder / "completions");
  write_page(folder / "completions" / "domefall", bash_completion(*program));
}

}  // namespace domefall
