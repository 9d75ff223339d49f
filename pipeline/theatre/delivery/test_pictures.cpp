#include "pipeline/theatre/delivery/test_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/theatre/delivery/drawing.h"
#include "trajectories/degree.h"

namespace domefall {
namespace {

// A Board is a picture of letters and lines, which grow with it, and its projection.
struct Board {
  explicit Board(const Projection& projection)
      : drawing(columns(projection), rows(projection), screen_sides(projection)),
        projection(projection),
        dome(traits_of(projection).half_sphere),
        width(drawing.width() * screen_sides(projection).x),
        height(drawing.height() * screen_sides(projection).y),
        size(std::min(width, height)),
        thin(std::max(1.0, size / 1500)) {}

  DrawingPoint middle() const { return {width / 2, height / 2}; }

  // Returns the place of an altitude and an azimuth (degrees; 0 is the front, 90 the right hand) on
  // a dome.
  DrawingPoint on_dome(double altitude, double azimuth) const {
    const double a = altitude * kDegree, z = azimuth * kDegree;
    const auto pixel =
        pixel_of(projection, {{std::cos(a) * std::sin(z), std::cos(a) * std::cos(z), std::sin(a)}});
    return pixel ? DrawingPoint{pixel->i - 0.5, pixel->j - 0.5} : middle();
  }

  // Titles stand here.
  DrawingPoint front() const {
    constexpr double kAltitude = 35;
    return dome ? on_dome(kAltitude, 0) : middle();
  }

  Drawing drawing;
  Projection projection;
  bool dome;
  double width, height;  // as Drawing counts
  double size;           // of the shorter side
  double thin;
};

// Draws a text that those read upright who turn towards it.
void text_on_dome(Board& board, const std::string& text, double altitude, double azimuth,
                  double letters) {
  const DrawingPoint at = board.on_dome(altitude, azimuth);
  board.drawing.text(text, at, letters, board.size, -azimuth * kDegree);
}

void draw_dome_grid(Board& board) {
  Drawing& drawing = board.drawing;
  const auto radius = [&](double altitude) {
    return board.on_dome(altitude, 0).y - board.middle().y;
  };
  for (int azimuth = 0; azimuth < 360; azimuth += 15) {
    const bool quarter = azimuth % 90 == 0;
    drawing.set_grey(quarter ? 0.8 : 0.4);
    drawing.line(board.on_dome(quarter ? 10 : 0, azimuth),
                 board.on_dome(quarter ? 90 : 80, azimuth), board.thin);
  }
  for (int altitude = 10; altitude < 90; altitude += 10) {
    drawing.set_grey(altitude % 30 == 0 ? 0.8 : 0.4);
    drawing.circle(board.middle(), radius(altitude), board.thin);
  }
  const double rim = 3 * board.thin;
  drawing.set_grey(1);
  drawing.circle(board.middle(), radius(0) - rim / 2, rim);
  constexpr double kSmall = 0.014, kLarge = 0.04, kTurn = 7.5;
  for (int quarter = 0; quarter < 4; ++quarter)
    for (int altitude = 10; altitude < 90; altitude += 10)
      text_on_dome(board, fmt::to_string(altitude), altitude + 1.5, 90 * quarter + 45 + kTurn,
                   kSmall * board.size);
  for (int azimuth = 15; azimuth < 360; azimuth += 15)
    if (azimuth % 90 != 0)
      text_on_dome(board, fmt::to_string(azimuth), 3, azimuth + 2, kSmall * board.size);
  constexpr std::array kSides{"FRONT", "RIGHT", "BACK", "LEFT"};
  for (std::size_t k = 0; k < kSides.size(); ++k) {
    const double azimuth = 90 * static_cast<double>(k);
    drawing.set_grey(1);
    text_on_dome(board, kSides[k], 5, azimuth, kLarge * board.size);
  }
}

void draw_flat_grid(Board& board) {
  Drawing& drawing = board.drawing;
  const double w = board.width, h = board.height;
  const auto frame = [&](double part) {
    const double x = w * (1 - part) / 2 + board.thin / 2, y = h * (1 - part) / 2 + board.thin / 2;
    drawing.line({x, y}, {w - x, y}, board.thin);
    drawing.line({w - x, y}, {w - x, h - y}, board.thin);
    drawing.line({w - x, h - y}, {x, h - y}, board.thin);
    drawing.line({x, h - y}, {x, y}, board.thin);
  };
  drawing.set_grey(1);
  frame(1);
  drawing.set_grey(0.6);
  frame(0.9);
  frame(0.8);
  drawing.line({w / 2, 0}, {w / 2, h}, board.thin);
  drawing.line({0, h / 2}, {w, h / 2}, board.thin);
  drawing.circle(board.middle(), 0.45 * board.size, board.thin);
}

// Draws square patches side by side, each of one colour.  The middle of their upper edge is at a
// place.
template <std::size_t Count>
void draw_patches(Board& board, DrawingPoint middle, double side,
                  const std::array<std::array<double, 3>, Count>& colours) {
  // The patches have whole pixels, so that no border is a mixture.
  const double whole = std::round(side);
  double x = std::round(middle.x - whole * Count / 2);
  for (const auto& [red, green, blue] : colours) {
    board.drawing.set_colour(red, green, blue);
    board.drawing.box({x, std::round(middle.y)}, whole, whole);
    x += whole;
  }
}

void draw_colours(Board& board, DrawingPoint middle) {
  constexpr std::size_t kSteps = 16;
  std::array<std::array<double, 3>, kSteps> greys{};
  for (std::size_t k = 0; k < kSteps; ++k)
    greys[k].fill(static_cast<double>(k) / static_cast<double>(kSteps - 1));
  constexpr std::array<std::array<double, 3>, 6> kPrimaries{
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}, {1, 1, 0}}};
  constexpr double kGrey = 0.018, kPrimary = 0.024;
  draw_patches(board, middle, kGrey * board.size, greys);
  draw_patches(board, {middle.x, middle.y + 1.2 * kGrey * board.size}, kPrimary * board.size,
               kPrimaries);
}

void write_lines(Board& board, const ShowLines& lines, DrawingPoint first, double letters,
                 double longest) {
  constexpr double kStep = 1.4, kTitle = 1.5;
  double y = first.y;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    board.drawing.set_grey(k == 0 ? 1 : 0.8);
    const double size = k == 0 ? kTitle * letters : letters;
    board.drawing.text(lines[k], {first.x, y}, size, longest);
    y += kStep * size;
  }
}

void draw_slate(Board& board, const ShowLines& lines) {
  constexpr double kLetters = 0.022, kAbove = 0.08, kLongest = 0.42;
  const DrawingPoint front = board.front();
  write_lines(board, lines, {front.x, front.y - kAbove * board.size}, kLetters * board.size,
              kLongest * board.size);
}

void draw_countdown(Board& board, int left, double passed) {
  constexpr double kRadius = 0.11, kNumber = 0.15;
  Drawing& drawing = board.drawing;
  const DrawingPoint front = board.front();
  const double radius = kRadius * board.size;
  drawing.set_grey(0.5);
  drawing.line({front.x - radius, front.y}, {front.x + radius, front.y}, board.thin);
  drawing.line({front.x, front.y - radius}, {front.x, front.y + radius}, board.thin);
  drawing.circle(front, radius, 2 * board.thin);
  const double turn = 2 * std::numbers::pi * passed;
  drawing.set_grey(0.8);
  drawing.line(front, {front.x + radius * std::sin(turn), front.y - radius * std::cos(turn)},
               3 * board.thin);
  drawing.set_grey(1);
  drawing.text(fmt::to_string(left), front, kNumber * board.size, board.size);
}

}  // namespace

GradedFrame alignment_frame(const Projection& projection, const ShowLines& lines) {
  Board board(projection);
  if (board.dome)
    draw_dome_grid(board);
  else
    draw_flat_grid(board);
  // The panel is no larger than it must be, since it hides a part of the grid.
  constexpr double kLetters = 0.011, kTitleAbove = 0.075, kPatchesBelow = 0.02;
  constexpr double kPanelWidth = 0.31, kPanelHeight = 0.165, kPanelAbove = 0.092, kLongest = 0.29;
  const DrawingPoint front = board.front();
  const double size = board.size;
  board.drawing.set_grey(0);
  board.drawing.box({front.x - kPanelWidth / 2 * size, front.y - kPanelAbove * size},
                    kPanelWidth * size, kPanelHeight * size);
  write_lines(board, lines, {front.x, front.y - kTitleAbove * size}, kLetters * size,
              kLongest * size);
  draw_colours(board, {front.x, front.y + kPatchesBelow * size});
  return board.drawing.finished();
}

int leader_frames(double frames_per_second) {
  return static_cast<int>(std::lround(frames_per_second * (kSlateSeconds + kCountdownSeconds)));
}

GradedFrame leader_frame(const Projection& projection, const ShowLines& lines,
                         double frames_per_second, int k) {
  Board board(projection);
  // Rounding must not move a frame at the beginning of a second into the second before.
  constexpr double kTiny = 1e-6;
  const double left = (leader_frames(frames_per_second) - k) / frames_per_second;
  if (left > kCountdownSeconds + kTiny) {
    draw_slate(board, lines);
  } else {
    const double number = std::ceil(left - kTiny);
    draw_countdown(board, static_cast<int>(number), std::max(0.0, number - left));
  }
  constexpr double kLetters = 0.016, kBelow = 0.15, kLongest = 0.42;
  const DrawingPoint front = board.front();
  board.drawing.set_grey(0.6);
  board.drawing.text(fmt::format("{}: frame {} of {} before the show", lines.front(), k + 1,
                                 leader_frames(frames_per_second)),
                     {front.x, front.y + kBelow * board.size}, kLetters * board.size,
                     kLongest * board.size);
  return board.drawing.finished();
}

}  // namespace domefall
