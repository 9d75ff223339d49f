// Writes the manual pages and the bash completion of domefall into a folder, when the build asks:
// domefall_make_manual DATE FOLDER.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "pipeline/cli/manual/bash_completion.h"
#include "pipeline/cli/manual/described_option.h"
#include "pipeline/cli/manual/man_page.h"
#include "pipeline/cli/verbs.h"

namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

void make_manual(const std::string& date, const fs::path& folder) {
  const auto program = domefall::describe_command_line();
  fs::create_directories(folder / "man1");
  write(folder / "man1" / "domefall.1", domefall::program_page(*program, date));
  for (const CLI::App* verb : domefall::verbs_of(*program))
    write(folder / "man1" / ("domefall-" + verb->get_name() + ".1"),
          domefall::verb_page(*verb, date));
  fs::create_directories(folder / "completions");
  write(folder / "completions" / "domefall", domefall::bash_completion(*program));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: domefall_make_manual DATE FOLDER\n", stderr);
    return 2;
  }
  try {
    make_manual(argv[1], argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
