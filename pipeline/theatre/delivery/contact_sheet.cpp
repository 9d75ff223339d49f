#include "pipeline/theatre/delivery/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "pipeline/base/in_parallel.h"
#include "pipeline/show/file/show_time.h"
#include "pipeline/theatre/delivery/drawing.h"

namespace domefall {
namespace {

constexpr int kSheetColumns = 6;

int part_begin(int k, int from, int to) {
  return static_cast<int>(static_cast<std::int64_t>(k) * from / to);
}

}  // namespace

GradedFrame reduced_picture(const GradedFrame& picture, int columns, int rows,
                            const ScreenSides& pixel) {
  const double wide = picture.width * pixel.x, high = picture.height * pixel.y;
  const double scale = std::min({1.0, columns / wide, rows / high});
  const auto scaled = [scale](double side) {
    return std::max(1, static_cast<int>(std::lround(scale * side)));
  };
  GradedFrame out(scaled(wide), scaled(high));
  if (out.width == picture.width && out.height == picture.height) return picture;
  std::vector<std::uint64_t> sums(3 * static_cast<std::size_t>(out.width));
  for (int y = 0; y < out.height; ++y) {
    std::fill(sums.begin(), sums.end(), 0);
    const int top = part_begin(y, picture.height, out.height),
              bottom = part_begin(y + 1, picture.height, out.height);
    for (int row = top; row < bottom; ++row)
      for (int x = 0; x < out.width; ++x) {
        const int end = part_begin(x + 1, picture.width, out.width);
        for (int column = part_begin(x, picture.width, out.width); column < end; ++column)
          for (int c = 0; c < 3; ++c)
            sums[static_cast<std::size_t>(3 * x + c)] += picture.row(row)[3 * column + c];
      }
    for (int x = 0; x < out.width; ++x) {
      const int width =
          part_begin(x + 1, picture.width, out.width) - part_begin(x, picture.width, out.width);
      const auto count =
          static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(bottom - top);
      for (int c = 0; c < 3; ++c)
        out.row(y)[3 * x + c] = static_cast<unsigned short>(
            (sums[static_cast<std::size_t>(3 * x + c)] + count / 2) / count);
    }
  }
  return out;
}

std::vector<int> frames_of_sheet(int count) {
  const int shown = std::min(count, kMostOnSheet);
  std::vector<int> frames;
  frames.reserve(static_cast<std::size_t>(shown));
  for (int k = 0; k < shown; ++k)
    frames.push_back(static_cast<int>((2 * std::int64_t{k} + 1) * count / (2 * shown)));
  return frames;
}

GradedFrame contact_sheet(const std::string& title, const std::vector<SheetPicture>& pictures) {
  constexpr int kGap = 12, kLabel = 22, kTitle = 48;
  constexpr double kLabelLetters = 13, kTitleLetters = 22;
  const int width = pictures.front().picture.width, height = pictures.front().picture.height;
  const int count = static_cast<int>(pictures.size()), across = std::min(count, kSheetColumns),
            down = (count + across - 1) / across;
  // Without this least width the title over a single small picture would have no room.
  const int cell = std::max(width, 160) + kGap;
  Drawing drawing(kGap + across * cell, kTitle + down * (height + kLabel + kGap));
  drawing.set_grey(1);
  drawing.text(title, {drawing.width() / 2.0, kTitle / 2.0}, kTitleLetters,
               drawing.width() - 2 * kGap);
  drawing.set_grey(0.75);
  for (int k = 0; k < count; ++k) {
    const SheetPicture& shown = pictures[static_cast<std::size_t>(k)];
    const int left = kGap + k % across * cell, top = kTitle + k / across * (height + kLabel + kGap);
    drawing.picture(shown.picture, left + (cell - kGap - width) / 2, top);
    drawing.text(shown.label, {left + (cell - kGap) / 2.0, top + height + kLabel / 2.0},
                 kLabelLetters, cell - kGap);
  }
  return drawing.finished();
}

GradedFrame sheet_of_frames(const GradedFrames& from, const Show& show,
                            const std::vector<int>& frames, const std::vector<std::string>& labels,
                            int threads) {
  std::vector<SheetPicture> pictures(frames.size());
  in_parallel(static_cast<int>(frames.size()), threads, [&](int k) {
    const auto at = static_cast<std::size_t>(k);
    pictures[at].picture = reduced_picture(from.read(frames[at]), kSheetPicture, kSheetPicture,
                                           screen_sides(show.projection));
    pictures[at].label =
        fmt::format("{}    {}", labels[at], clock_text(frames[at] / show.frames_per_second));
  });
  return contact_sheet(show.title, pictures);
}

}  // namespace domefall
