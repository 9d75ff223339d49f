// Inner loops are compiled for several instruction sets, and one of these is used at run time.  It
// is the widest that the processor has, or the one that DOMEFALL_SIMD names in the environment.
// All of them give the same bytes, which the tests show by running each.
#pragma once

#include <atomic>
#include <string>

#if defined(__x86_64__) && defined(__GNUC__)
#define DOMEFALL_X86 1
#else
#define DOMEFALL_X86 0
#endif

namespace domefall {

// kPortable is what the compiler emits by default: SSE2 on x86-64.
enum class Simd : signed char { kPortable, kAvx2, kAvx512 };

// The levels stand in order of width, narrowest first.
inline constexpr Simd kEverySimd[] = {Simd::kPortable, Simd::kAvx2, Simd::kAvx512};

// Returns the word by which DOMEFALL_SIMD names a level: portable, avx2 or avx512.
const char* name_of(Simd level);

// Says whether the processor has a level.  Every processor has kPortable, and only x86-64 has the
// others.  Those count only with F16C, which comes with them unless a virtual machine hides it.
bool processor_has(Simd level);

// Returns the level that `word` names, or the widest that the processor has if `word` is empty.  It
// throws InputError for an unknown word and for a level that the processor lacks.
Simd simd_named(const std::string& word);

// Sets the level for all threads from now on.  It throws InputError if the processor lacks it.
void use_simd(Simd level);

namespace simd_detail {
inline constexpr signed char kUndecided = -1;
// One level holds for the whole program.  Threads that find it undecided at the same time choose
// the same one.
extern std::atomic<signed char> level;
Simd decide();
}  // namespace simd_detail

// Returns the level in use.  The first call reads the environment and throws as simd_named does.
inline Simd simd_in_use() {
  const signed char level = simd_detail::level.load(std::memory_order_relaxed);
  return level != simd_detail::kUndecided ? static_cast<Simd>(level) : simd_detail::decide();
}

// A Dispatched loop is compiled once for each level and called through the one in use:
//
//     [[gnu::always_inline]] inline void add_loop(const float* a, int count, float* out) { ... }
//     Dispatched<add_loop> add;
//
// The loop and the inline functions that it calls are inlined into a function for one instruction
// set and so are compiled for that set.  The body of a lambda would not be.  A loop must consist of
// plain IEEE operations and selections, none of them fused, so that every level gives the same
// bits.
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
