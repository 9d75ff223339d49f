#include "pipeline/program/cli/frame_choice.h"

#include <fmt/format.h>

#include "pipeline/base/errors.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/program/cli/number_in.h"
#include "pipeline/show/file/show_time.h"
#include "pipeline/show/nearest_word.h"

namespace domefall {

void add_frame_choice(CLI::App& verb, FrameChoice& choice) {
  auto* frame = verb.add_option("--frame", choice.frame, "frame number, from 0")
                    ->check(number_in(0, kMostFrames - 1));
  verb.add_option("--at", choice.at, "instead: a time of the show, 34.5, 0:34.5 or a marker")
      ->type_name("TIME")
      ->excludes(frame);
}

int chosen_frame(const FrameChoice& choice, const Show& show) {
  if (choice.at.empty())
    return parse_frames(fmt::to_string(choice.frame), frame_count(show)).front();
  const auto seconds = parse_time(choice.at, show.markers);
  const double end = end_of(show);
  if (!seconds) {
    std::vector<std::string_view> names;
    for (const Marker& marker : show.markers) names.push_back(marker.name);
    throw InputError("--at " + choice.at + ": expected seconds, a time such as 1:02.5" +
                     (names.empty() ? "" : " or a marker (" + listed(names) + ")"));
  }
  if (*seconds > end)
    throw InputError(fmt::format("--at {}: the show ends at {} s ({})", choice.at,
                                 short_number(end), clock_text(end)));
  return nearest_frame(show, *seconds);
}

}  // namespace domefall
