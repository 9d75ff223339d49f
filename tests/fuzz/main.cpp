// One program holds all targets, since linking takes longer than compiling them.  The build gives
// it a link for each, and the name by which it is called, fuzz_<target>, chooses.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "tests/fuzz/targets.h"

namespace domefall::fuzz {
namespace {

struct NamedTarget {
  std::string_view name;
  Target* run;
};
constexpr NamedTarget kTargets[] = {{"catalogue", catalogue}, {"colour_config", colour_config},
                                    {"frame", frame},         {"healpix", healpix},
                                    {"picture", picture},     {"show", show},
                                    {"sky_file", sky_file},   {"star_file", star_file},
                                    {"table", table}};

Target* chosen = nullptr;

}  // namespace
}  // namespace domefall::fuzz

// libFuzzer calls these two: the first once, the second for each input.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** argv) {
  const std::string called = std::filesystem::path((*argv)[0]).filename();
  for (const auto& target : domefall::fuzz::kTargets)
    if (called == "fuzz_" + std::string(target.name)) domefall::fuzz::chosen = target.run;
  if (domefall::fuzz::chosen) return 0;
  std::fprintf(stderr, "%s is the name of no target: see tests/fuzz/run\n", called.c_str());
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  domefall::fuzz::chosen(data, size);
  return 0;
}
