// A ShowWarning is something that `check` and the live preview warn of, and its place in the show.
#pragma once

#include <string>

namespace domefall {

inline constexpr int kWholeShow = -1;
struct ShowWarning {
  double time_s = 0;  // show seconds
  int frame = 0;
  int segment = 0;  // kWholeShow if it belongs to no segment
  std::string text;
};

}  // namespace domefall
