#include "pipeline/report/machine.h"

#include <fmt/chrono.h>

#include <ctime>
#include <fstream>
#include <thread>

namespace domefall {
namespace {

// Linux describes every logical processor by lines of the form "model name : ...".  The first one
// counts.
std::string processor_model() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
      return line.substr(colon + 2);
  }
  return "unknown processor";
}

std::string today() { return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))); }

// clang defines __VERSION__ as well, so it is asked for first.
constexpr const char* kCompiler =
#if defined(__clang__)
    "clang " __clang_version__;
#else
    "g++ " __VERSION__;
#endif

}  // namespace

Machine this_machine() {
  return {processor_model(), std::thread::hardware_concurrency(), kCompiler, DOMEFALL_VERSION,
          today()};
}

std::string machine_table() {
  const Machine on = this_machine();
  return fmt::format(
      "| | |\n|---|---|\n"
      "| processor | {}, {} cores |\n| compiler | {} |\n| Domefall | {} |\n| date | {} |\n\n",
      on.processor, on.cores, on.compiler, on.version, on.date);
}

}  // namespace domefall
