#include "pipeline/cli/frame_sheet.h"

#include <fmt/format.h>

#include "pipeline/deliver/contact_sheet.h"
#include "pipeline/deliver/in_parallel.h"
#include "pipeline/show/show_time.h"

namespace domefall {

GradedFrame sheet_of_frames(const GradedFrames& from, const Show& show,
                            const std::vector<int>& frames, const std::vector<std::string>& labels,
                            int threads) {
  std::vector<SheetPicture> pictures(frames.size());
  in_parallel(static_cast<int>(frames.size()), threads, [&](int k) {
    const auto at = static_cast<std::size_t>(k);
    pictures[at].picture = reduced_picture(from.read(frames[at]), kSheetPicture, kSheetPicture);
    pictures[at].label =
        fmt::format("{}    {}", labels[at], clock_text(frames[at] / show.frames_per_second));
  });
  return contact_sheet(show.title, pictures);
}

}  // namespace domefall
