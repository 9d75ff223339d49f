// Looks with different numbers of taps: those with as many are taken together.
#include <algorithm>

#include "pipeline/render/sky_sampler.h"

namespace domefall {
namespace {

using Order = std::array<std::uint16_t, SkyPlaces::kSize>;

// The looks by their number of taps; `ends`: where those of each number end.
void sort_by_taps(const std::uint8_t* taps, int count,
                  std::array<int, SkySampler::kMostTaps + 1>& ends, Order& order) {
  ends.fill(0);
  for (int k = 0; k < count; ++k) ++ends[taps[k]];
  for (int before = 0; int& end : ends) {
    const int members = end;
    end = before;  // the start, until they are in
    before += members;
  }
  for (int k = 0; k < count; ++k)
    order[static_cast<std::size_t>(ends[taps[k]]++)] = static_cast<std::uint16_t>(k);
}

void gather(const SkyPlaces::Column& from, const std::uint16_t* order, int count,
            SkyPlaces::Column& to) {
  for (int m = 0; m < count; ++m) to[m] = from[order[m]];
}

void gather(const SkyPlaces& from, const std::uint16_t* order, int count, bool oblong,
            SkyPlaces& to) {
  gather(from.x, order, count, to.x), gather(from.y, order, count, to.y);
  gather(from.z, order, count, to.z);
  gather(from.gain, order, count, to.gain), gather(from.tone, order, count, to.tone);
  gather(from.wide, order, count, to.wide);
  if (!oblong) return;
  gather(from.narrow, order, count, to.narrow);
  gather(from.ax, order, count, to.ax), gather(from.ay, order, count, to.ay);
  gather(from.az, order, count, to.az);
}

}  // namespace

bool SkySampler::any_minified(const SkyPlaces& places, int count, int taps) const {
  float wide = 0, narrow = 0;
  for (int k = 0; k < count; ++k) {
    wide = std::max(wide, places.wide[k]);
    if (taps > 1) narrow = std::max(narrow, places.narrow[k]);
  }
  return is_minified(wide, narrow, taps);
}

void SkySampler::sample_each(const SkyPlaces& places, int count, const std::uint8_t* taps,
                             float* rgb) const {
  std::array<int, kMostTaps + 1> ends;
  Order order;
  sort_by_taps(taps, count, ends, order);
  SkyPlaces group;
  std::array<float, 3 * SkyPlaces::kSize + 1> light;
  for (int n = 1; n <= kMostTaps; ++n) {
    const int first = ends[n - 1], members = ends[n] - first;
    if (members == 0) continue;
    if (members == count) {
      sample(places, count, n, any_minified(places, count, n), rgb);
      return;
    }
    gather(places, &order[first], members, n > 1, group);
    sample(group, members, n, any_minified(group, members, n), light.data());
    for (int m = 0; m < members; ++m) std::copy_n(&light[3 * m], 3, rgb + 3 * order[first + m]);
  }
}

}  // namespace domefall
