#include "pipeline/farm/equal_chunks.h"

#include <cstddef>
#include <numeric>

namespace domefall {

std::vector<std::vector<int>> equal_chunks(const std::vector<int>& frames,
                                           const std::vector<double>& costs, int most) {
  const double share = std::accumulate(costs.begin(), costs.end(), 0.0) / most;
  std::vector<std::vector<int>> chunks;
  double before = 0;  // what all frames before this one cost
  int last_part = -1;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    // A frame belongs to the share of the whole in which its middle lies.
    const int part = static_cast<int>((before + costs[k] / 2) / share);
    if (part != last_part) chunks.emplace_back();
    chunks.back().push_back(frames[k]);
    last_part = part;
    before += costs[k];
  }
  return chunks;
}

}  // namespace domefall
