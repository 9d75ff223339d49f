#include "pipeline/report/machine.h"

#include <array>
#include <ctime>
#include <fstream>
#include <thread>

namespace domefall {
namespace {

std::string processor_model() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
      return line.substr(colon + 2);
  }
  return "unknown processor";
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d", &utc);
  return text.data();
}

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
  return "| | |\n|---|---|\n| processor | " + on.processor + ", " + std::to_string(on.cores) +
         " cores |\n| compiler | " + on.compiler + " |\n| Domefall | " + on.version +
         " |\n| date | " + on.date + " |\n\n";
}

}  // namespace domefall
