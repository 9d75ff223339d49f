// The inner loops for several instruction sets, one of which is used: the widest that the processor
// has, or a narrower one that DOMEFALL_SIMD names in the environment.  All give the same bytes; a test
// can ask for each.
#pragma once

#include <atomic>
#include <string>

#if defined(__x86_64__) && defined(__GNUC__)
#define DOMEFALL_X86 1
#else
#define DOMEFALL_X86 0
#endif

namespace domefall {

// kPortable: what the compiler makes without being told of the processor; SSE2 on x86-64.
enum class Simd : signed char { kPortable, kAvx2, kAvx512 };

// Narrowest first.
inline constexpr Simd kEverySimd[] = {Simd::kPortable, Simd::kAvx2, Simd::kAvx512};

// As DOMEFALL_SIMD has it: portable, avx2, avx512.
const char* name_of(Simd level);

// kPortable everywhere; false for the others where the program is not for x86-64.
bool processor_has(Simd level);

// The level that a word asks for; the widest that there is for an empty one.  Throws InputError for
// an unknown word and for a level that the processor lacks.
Simd simd_named(const std::string& word);

// From now on, in all threads.  Throws InputError if the processor lacks it.
void use_simd(Simd level);

namespace simd_detail {
inline constexpr signed char kUndecided = -1;
extern std::atomic<signed char> level;
Simd decide();
}  // namespace simd_detail

// The level in use.  The first call looks into the environment, and throws InputError as simd_named.
inline Simd simd_in_use() {
  const signed char level = simd_detail::level.load(std::memory_order_relaxed);
  return level != simd_detail::kUndecided ? static_cast<Simd>(level) : simd_detail::decide();
}

// A function that is compiled once for each level:
//
//     [[gnu::always_inline]] inline void add_loop(const float* a, int count, float* out) { ... }
//     Dispatched<add_loop> add;
//
// The loop takes on the instructions of the function that it is inlined into, together with the
// inline functions that it calls; a lambda would not.  It must be a plain loop of IEEE operations and
// selections, none of which may be fused.
template <auto kLoop>
class Dispatched;

template <typename Result, typename... Arguments, Result (*kLoop)(Arguments...)>
class Dispatched<kLoop> {
 public:
  Result operator()(Arguments... arguments) const {
#if DOMEFALL_X86
    switch (simd_in_use()) {
      case Simd::kAvx512:
        return avx512(arguments...);
      case Simd::kAvx2:
        return avx2(arguments...);
      case Simd::kPortable:
        break;
    }
#endif
    return portable(arguments...);
  }

 private:
#if DOMEFALL_X86
  [[gnu::target("avx512f"), gnu::noinline]] static Result avx512(Arguments... arguments) {
    return kLoop(arguments...);
  }
  [[gnu::target("avx2"), gnu::noinline]] static Result avx2(Arguments... arguments) {
    return kLoop(arguments...);
  }
#endif
  [[gnu::noinline]] static Result portable(Arguments... arguments) { return kLoop(arguments...); }
};

}  // namespace domefall
