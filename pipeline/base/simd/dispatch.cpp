#include "pipeline/base/simd/dispatch.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "pipeline/base/errors.h"

#if DOMEFALL_X86
#include <cpuid.h>
#endif

namespace domefall {
namespace {

constexpr const char* kVariable = "DOMEFALL_SIMD";

void require(Simd level) {
  if (!processor_has(level))
    throw InputError(std::string(kVariable) + ": this processor has no " + name_of(level));
}

#if DOMEFALL_X86
// Every processor with AVX2 also has F16C, which converts half floats, but a virtual machine may
// hide F16C.  It is asked for by cpuid, because Clang's __builtin_cpu_supports does not know its
// name.
bool converts_halves() {
  unsigned int a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_F16C) != 0;
}
#endif

}  // namespace

const char* name_of(Simd level) {
  switch (level) {
    case Simd::kAvx512:
      return "avx512";
    case Simd::kAvx2:
      return "avx2";
    case Simd::kPortable:
      break;
  }
  return "portable";
}

bool processor_has(Simd level) {
#if DOMEFALL_X86
  __builtin_cpu_init();
  if (level == Simd::kAvx512) return __builtin_cpu_supports("avx512f") && converts_halves();
  if (level == Simd::kAvx2) return __builtin_cpu_supports("avx2") && converts_halves();
#endif
  return level == Simd::kPortable;
}

Simd simd_named(const std::string& word) {
  if (word.empty())
    return *std::find_if(std::rbegin(kEverySimd), std::rend(kEverySimd), processor_has);
  const auto* found = std::find_if(std::begin(kEverySimd), std::end(kEverySimd),
                                   [&](Simd level) { return word == name_of(level); });
  if (found == std::end(kEverySimd))
    throw InputError(std::string(kVariable) + " is portable, avx2 or avx512, not '" + word + "'");
  require(*found);
  return *found;
}

void use_simd(Simd level) {
  require(level);
  simd_detail::level.store(static_cast<signed char>(level), std::memory_order_relaxed);
}

namespace simd_detail {

std::atomic<signed char> level = kUndecided;

Simd decide() {
  const char* word = std::getenv(kVariable);
  const Simd chosen = simd_named(word ? word : "");
  use_simd(chosen);
  return chosen;
}

}  // namespace simd_detail

}  // namespace domefall
