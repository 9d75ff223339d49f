#include "pipeline/theatre/movie/chapters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace domefall {
namespace {

// A backslash takes their meaning from these characters, and a line break ends a value.
std::string escaped(const std::string& value) {
  std::string text;
  for (const char c : value) {
    if (std::string_view("=;#\\\n").find(c) != std::string_view::npos) text += '\\';
    text += c;
  }
  return text;
}

}  // namespace

std::string chapters(const Show& show, int first, int count) {
  if (show.markers.empty()) return "";
  const double begin = first / show.frames_per_second, end = begin + count / show.frames_per_second;
  std::vector<Marker> markers{{show.title, begin}};
  double latest = -1;  // of the markers up to the first frame, the last of which names its chapter
  for (const Marker& marker : show.markers) {
    if (marker.at_s >= end) continue;
    if (marker.at_s > begin)
      markers.push_back(marker);
    else if (marker.at_s >= latest)
      markers[0].name = marker.name, latest = marker.at_s;
  }
  std::ranges::stable_sort(markers, {}, &Marker::at_s);
  constexpr double kThousand = 1000;
  std::string text = ";FFMETADATA1\n";
  for (std::size_t k = 0; k < markers.size(); ++k) {
    const auto at = [&](double seconds) { return std::lround((seconds - begin) * kThousand); };
    text += fmt::format("[CHAPTER]\nTIMEBASE=1/1000\nSTART={}\nEND={}\ntitle={}\n",
                        at(markers[k].at_s), at(k + 1 < markers.size() ? markers[k + 1].at_s : end),
                        escaped(markers[k].name));
  }
  return text;
}

}  // namespace domefall
