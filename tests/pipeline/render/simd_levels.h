// What the tests share that compare each width of SIMD with the portable code.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/sources/sky/sky_pyramid.h"

namespace domefall {

class ScopedSimd {
 public:
  explicit ScopedSimd(Simd level) : before_(simd_in_use()) { use_simd(level); }
  ~ScopedSimd() { use_simd(before_); }
  ScopedSimd(const ScopedSimd&) = delete;
  ScopedSimd& operator=(const ScopedSimd&) = delete;

 private:
  Simd before_;
};

// The results of a computation, bit by bit: -0 is not 0, and one NaN is not another.
class Bytes {
 public:
  template <class T>
  void add(const T* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (count == 0) return;
    const std::size_t before = bytes_.size();
    bytes_.resize(before + count * sizeof(T));
    std::memcpy(&bytes_[before], values, count * sizeof(T));
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(values.data(), values.size());
  }

  void add(const Bytes& other) { add(other.bytes_); }

  std::size_t size() const { return bytes_.size(); }
  // Returns the first byte that differs, or -1 if none does.
  std::ptrdiff_t difference(const Bytes& other) const {
    if (bytes_ == other.bytes_) return -1;
    return std::mismatch(bytes_.begin(), bytes_.end(), other.bytes_.begin(), other.bytes_.end())
               .first -
           bytes_.begin();
  }

 private:
  std::vector<std::byte> bytes_;
};

// A test for each level but the portable one.  It is skipped where the processor lacks the level.
class SimdLevel : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override {
    if (!processor_has(GetParam())) GTEST_SKIP() << "this processor has no " << name_of(GetParam());
  }
  // Compares the Bytes that `make` computes at both levels, and returns how many they are.
  template <class Make>
  std::size_t compare(const std::string& what, const Make& make) {
    const auto at = [&](Simd level) {
      const ScopedSimd scoped(level);
      return make();
    };
    const Bytes portable = at(Simd::kPortable), here = at(GetParam());
    EXPECT_EQ(portable.difference(here), -1)
        << what << ": the first byte of " << portable.size() << " that differs";
    return portable.size();
  }
};

inline const auto kLevels = testing::Values(Simd::kAvx2, Simd::kAvx512);
inline std::string level_name(const testing::TestParamInfo<Simd>& level) {
  return name_of(level.param);
}

// Paints noise over a sky, as bright as a real one; thermal light is from 2000 to 30000 K.
inline void noise(const SkyPyramid& pyramid) {
  const bool thermal = pyramid.kind == SkyMapKind::kThermal;
  paint(pyramid.levels[0], [&](const V3d& n, float* channel) {
    std::mt19937 random(static_cast<unsigned>(1e6 * (n.x + 2 * n.y + 4 * n.z + 8)));
    std::uniform_real_distribution<float> u(10, 8000);
    if (thermal) {
      channel[0] = u(random) / 8;
      channel[1] = channel[0] * (3 + u(random) / 2000);
    } else {
      for (int k = 0; k < 3; ++k) channel[k] = u(random);
    }
  });
}

}  // namespace domefall
