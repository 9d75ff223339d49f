#include "pipeline/sources/sky/sky_pyramid.h"

#include <sys/mman.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

#include "pipeline/sources/sky/cube_face.h"

namespace domefall {
namespace {

// Returns this number of bytes, all 0, for an array that is read in no order.  They come in large
// pages where the system has them, so that the processor keeps the addresses of all.
std::shared_ptr<void> large_pages(std::size_t bytes) {
  // This is a large page of Linux on x86-64. aligned_alloc() needs a size that is a multiple of it.
  constexpr std::size_t kPage = std::size_t{2} << 20;
  const std::size_t whole = (bytes + kPage - 1) / kPage * kPage;
  void* memory = std::aligned_alloc(kPage, whole);
  if (memory == nullptr) throw std::bad_alloc();
  madvise(memory, whole, MADV_HUGEPAGE);  // the system may ignore this
  // A page comes into being when it is first written, so the advice precedes the zeros.
  std::memset(memory, 0, bytes);
  return {memory, [](void* m) { std::free(m); }};
}

constexpr int kGreatestExponent = 14;  // of the brightest texel; halves reach almost 2^16

// Returns the texel of the next level that covers these four.  The sum is in single precision and
// is rounded to a half once.
SkyTexel mean(const SkyTexel& a, const SkyTexel& b, const SkyTexel& c, const SkyTexel& d) {
  SkyTexel out{};
  for (int k = 0; k < 4; ++k)
    out.channel[k] = half_bits((half_value(a.channel[k]) + half_value(b.channel[k]) +
                                half_value(c.channel[k]) + half_value(d.channel[k])) /
                               4);
  return out;
}

// A place lies between two inner texels.  `part` is its distance from the first, from 0 to 1.
struct Between {
  int first, second;
  float part;
};

// Returns the place of a face's coordinate u among its texels, whose centres are at u = (2 i + 1)/n
// - 1.  A place beyond the outermost centres is moved to the nearest.
Between between(double u, int n) {
  const double x = std::clamp((u + 1) / 2 * n - 0.5, 0.0, n - 1.0);
  const int first = static_cast<int>(x);
  return {first, std::min(first + 1, n - 1), static_cast<float>(x - first)};
}

// Returns the light of the neighbouring face in the direction of a texel of the border.
SkyTexel sample_across(const SkyPyramid::Level& level, int face, int i, int j) {
  const int n = level.size;
  // direction_of() also holds beyond the edge, and face_of() then finds the face across it.
  const FacePoint at = face_of(direction_of(texel_centre(face, i, j, n)));
  const Between x = between(at.u, n), y = between(at.v, n);
  const SkyTexel &a = level.at(at.face, x.first, y.first),
                 &b = level.at(at.face, x.second, y.first),
                 &c = level.at(at.face, x.first, y.second),
                 &d = level.at(at.face, x.second, y.second);
  SkyTexel out{};
  for (int k = 0; k < 4; ++k) {
    const auto mix = [](float from, float to, float part) { return from + part * (to - from); };
    out.channel[k] =
        half_bits(mix(mix(half_value(a.channel[k]), half_value(b.channel[k]), x.part),
                      mix(half_value(c.channel[k]), half_value(d.channel[k]), x.part), y.part));
  }
  return out;
}

// Makes a level from the next finer one.  Each of its texels is the mean of four.  Its border is
// filled anew, from its own inner texels.
void halve(const SkyPyramid::Level& fine, const SkyPyramid::Level& coarse) {
  for (int face = 0; face < 6; ++face)
    for (int j = 0; j < coarse.size; ++j) {
      const SkyTexel* a = &fine.at(face, 0, 2 * j);
      const SkyTexel* b = &fine.at(face, 0, 2 * j + 1);
      SkyTexel* out = &coarse.at(face, 0, j);
      for (int i = 0; i < coarse.size; ++i, a += 2, b += 2) out[i] = mean(a[0], a[1], b[0], b[1]);
    }
  fill_border(coarse);
}

// Sets one row.  `row` counts all rows of all faces, including those of borders.
void paint_row(const SkyPyramid::Level& level, int row, const SkyPainter& painter, int across) {
  const int n = level.size, fine = n * across, face = row / (n + 2), j = row % (n + 2) - 1;
  for (int i = -1; i <= n; ++i) {
    std::array<float, 4> sum{};
    for (int y = 0; y < across; ++y)
      for (int x = 0; x < across; ++x) {
        std::array<float, 4> channel{};
        // The samples are the centres of a grid that is `across` times as fine.  In the border they
        // lie beyond the face.
        painter(direction_of(texel_centre(face, i * across + x, j * across + y, fine)),
                channel.data());
        for (int k = 0; k < 4; ++k) sum[k] += channel[k];
      }
    SkyTexel& texel = level.at(face, i, j);
    for (int k = 0; k < 4; ++k)
      texel.channel[k] = half_bits(sum[k] / static_cast<float>(across * across));
  }
}

}  // namespace

double sky_unit(double greatest) {
  if (!(greatest > 0)) return 1;
  // With 2^e <= greatest < 2^(e + 1), greatest over 2^(e - 13) is at least 2^13 and less than 2^14.
  return std::ldexp(1.0, std::ilogb(greatest) + 1 - kGreatestExponent);
}

std::vector<int> level_sizes(int size) {
  std::vector<int> sizes;
  for (; size >= 1; size /= 2) sizes.push_back(size);
  return sizes;
}

SkyTexel& SkyPyramid::Level::at(int face_number, int i, int j) const {
  return face(face_number)[static_cast<std::size_t>(j + 1) * static_cast<std::size_t>(size + 2) +
                           static_cast<std::size_t>(i + 1)];
}

SkyPyramid::SkyPyramid(SkyMapKind of_kind, double in_unit, int size)
    : kind(of_kind), unit(in_unit) {
  const std::vector<int> sizes = level_sizes(size);
  std::size_t total = 0;
  for (const int n : sizes) total += 6 * SkyLevel::face_texels(n);
  // All levels lie in one piece of memory, the finest first.
  owner = large_pages(total * sizeof(SkyTexel));
  auto* next = static_cast<SkyTexel*>(owner.get());
  for (const int n : sizes) {
    levels.push_back({n, next});
    next += 6 * SkyLevel::face_texels(n);
  }
}

SkyPyramid::SkyPyramid(SkyMapKind of_kind, double in_unit, std::vector<Level> in,
                       std::shared_ptr<void> of_owner)
    : kind(of_kind), unit(in_unit), levels(std::move(in)), owner(std::move(of_owner)) {}

void SkyPyramid::finish() const {
  for (std::size_t k = 1; k < levels.size(); ++k) halve(levels[k - 1], levels[k]);
}

SkyMap SkyPyramid::map() const {
  std::vector<SkyLevel> read;
  read.reserve(levels.size());
  for (const Level& level : levels) read.push_back({level.size, level.texels});
  return {kind, unit, std::move(read), owner};
}

void fill_border(const SkyPyramid::Level& level) {
  const int n = level.size;
  for (int face = 0; face < 6; ++face)
    // A corner of the border is set twice, to the same value.
    for (int k = -1; k <= n; ++k) {
      level.at(face, k, -1) = sample_across(level, face, k, -1);
      level.at(face, k, n) = sample_across(level, face, k, n);
      level.at(face, -1, k) = sample_across(level, face, -1, k);
      level.at(face, n, k) = sample_across(level, face, n, k);
    }
}

void paint(const SkyPyramid::Level& level, const SkyPainter& painter, int across) {
  // The caller may hold a lock.  A thread that waits here for the last rows must not begin another
  // task in the meantime, since that task may wait for the same lock.
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(0, 6 * (level.size + 2),
                      [&](int row) { paint_row(level, row, painter, across); });
  });
}

}  // namespace domefall
