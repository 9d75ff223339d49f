#include "pipeline/program/preview/live_pictures.h"

#include <algorithm>

#include "pipeline/base/errors.h"
#include "pipeline/image/encode/picture_writers.h"
#include "pipeline/image/frame_file.h"
#include "pipeline/program/preview/screen_view.h"

namespace domefall {
namespace {

// A moving picture leaves out stars that are fainter than this V.  Half of the time of a picture
// would go into points that are lost among their neighbours while they move.
constexpr double kFaintestMoving = 7;
constexpr int kMovingQuality = 85, kStillQuality = 95;  // of JPEGs

// A picture stands for a frame of a dome of this size, which is graded by a table.
constexpr int kLargeDome = 4096;

bool same_grade(const GradeSettings& a, const GradeSettings& b) {
  return a.config == b.config && a.shipped && b.shipped && a.display == b.display &&
         a.view == b.view && a.dome.light == b.dome.light &&
         a.dome.reflectance == b.dome.reflectance;
}

bool keyframes_magnitudes(const Show& show) {
  return std::any_of(show.timeline.begin(), show.timeline.end(), [](const Segment& segment) {
    return std::any_of(kEverySky.begin(), kEverySky.end(), [&](SkyRegion sky) {
      return segment.curves[max_magnitude_channel(sky)].has_value();
    });
  });
}

bool same_stars(const Show& a, const Show& b) {
  if (keyframes_magnitudes(a) || keyframes_magnitudes(b)) return false;
  return a.star_epoch == b.star_epoch &&
         std::all_of(kEverySky.begin(), kEverySky.end(),
                     [&](SkyRegion sky) { return a.sky[sky].stars == b.sky[sky].stars; });
}

// Changes a state as a request asks.
void change(const PictureRequest& request, FrameState& state) {
  state.settings.ev += request.ev;
  state.draft = request.moving;
  for (const SkyRegion region : kEverySky) {
    FrameSettings::Sky& sky = state.settings.sky[region];
    if (!request.skies[region]) sky.background_gain = sky.star_gain = 0;
    if (!request.stars) sky.star_gain = 0;
    if (request.moving && sky.max_magnitude > kFaintestMoving) {
      sky.max_magnitude = kFaintestMoving;
      sky.soft_limit = true;
    }
  }
  if (!state.vanishing) return;
  auto vanishing = std::make_shared<FrameState>(*state.vanishing);
  change(request, *vanishing);
  state.vanishing = vanishing;
}

// A ByteString is a string into which an encoder writes.
class ByteString final : public ByteSink {
 public:
  void write(std::string_view piece) noexcept override {
    bytes_.replace(position_, std::min(piece.size(), bytes_.size() - position_), piece);
    position_ += piece.size();
  }
  void seek(std::uint64_t position) noexcept override { position_ = position; }
  std::uint64_t position() const override { return position_; }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
  std::uint64_t position_ = 0;
};

}  // namespace

LivePictures::LivePictures(Show show, int threads)
    : wanted_threads_(threads),
      show_(std::move(show)),
      prepared_(show_),
      usual_(for_a_screen(show_.grade)),
      renderer_(std::make_unique<Renderer>(prepared_, threads)),
      labels_(std::make_unique<StarLabels>(prepared_)) {
  set_file_threads(renderer_->threads());
}

LivePictures::~LivePictures() { wait_for_tables(); }

void LivePictures::wait_for_tables() {
  for (std::thread& making : making_tables_) making.join();
  making_tables_.clear();
}

// The first picture does not wait for the table, although without it a grade takes ten times as
// long, 0.1 us a pixel.  Nor does a grade that follows wait for the table of the one before.
void LivePictures::make_table() {
  if (table_made_) return;
  constexpr std::size_t kMost = 4;
  if (making_tables_.size() == kMost) wait_for_tables();
  table_made_ = std::make_shared<std::atomic<bool>>(false);
  making_tables_.emplace_back([made = table_made_, grader = usual_.as_for(kLargeDome, kLargeDome)] {
    try {
      grader.grade(HalfFrame(1, 1));
      *made = true;
    } catch (const std::exception&) {
      // Pictures are graded by the formulas, as before.
    }
  });
}

void LivePictures::take(Show show) {
  const bool regrade = !same_grade(show.grade, show_.grade);
  std::optional<Grader> grader;
  if (regrade) grader.emplace(for_a_screen(show.grade));
  if (!same_stars(show, show_)) {
    auto fresh = std::make_unique<Renderer>(prepared_, wanted_threads_);
    renderer_ = std::move(fresh);
    labels_ = std::make_unique<StarLabels>(prepared_);
  }
  show_ = std::move(show);
  prepared_ = show_;
  if (!grader) return;
  usual_ = *grader;
  others_.clear();
  table_made_.reset();
}

FrameState LivePictures::state_for(const PictureRequest& request) const {
  FrameState state = frame_state(show_, request.frame);
  const bool straight = request.effects && !request.effects->lensing;
  if (straight && !has_rest(state.observer))
    throw InputError("light is bent inside the horizon: there is no picture without lensing");
  see_in(show_, request.projection, state);
  if (request.look) turn_to(*request.look, state);
  change(request, state);
  return state;
}

void LivePictures::prepare(const PictureRequest& request) {
  prepared_.effects = request.effects.value_or(show_.effects);
  prepared_.overlays = request.overlays;
  // The instants of an open shutter follow the show's camera, and not one that was turned.
  prepared_.exposure.shutter = 0;
}

const Grader& LivePictures::grader_for(const PictureRequest& request) {
  if (request.display.empty() && request.view.empty()) return usual_;
  const auto names = std::pair(request.display, request.view);
  const auto known = others_.find(names);
  if (known != others_.end()) return known->second;
  GradeSettings settings = for_a_screen(show_.grade);
  if (!request.display.empty()) settings.display = request.display;
  if (!request.view.empty() || !request.display.empty()) settings.view = request.view;
  // Each grade keeps a table of 18 MB.
  constexpr std::size_t kMost = 8;
  if (others_.size() == kMost) others_.clear();
  return others_.emplace(names, Grader(settings)).first->second;
}

LivePicture LivePictures::make(const PictureRequest& request, const std::atomic<bool>& stop) {
  LivePicture picture;
  picture.state = state_for(request);
  prepare(request);
  renderer_->stop_when(&stop);
  renderer_->render(picture.state, frame_);
  picture.jpeg = encoded(request, picture.state, frame_);
  make_table();
  return picture;
}

std::string LivePictures::encoded(const PictureRequest& request, const FrameState& state,
                                  const HalfFrame& frame) {
  const Grader& asked = grader_for(request);
  Grader grader = asked.with(state.cdl);
  if (&asked != &usual_ || (table_made_ && *table_made_))
    grader = grader.as_for(kLargeDome, kLargeDome);
  JpegHead head{.quality = request.moving ? kMovingQuality : kStillQuality, .frame = request.frame};
  ByteString bytes;
  if (!grader.dome_light() || !is_domemaster(show_.projection)) {
    write_jpeg(bytes,
               {frame.width, frame.height,
                [&](int first, int end, unsigned short* rgb) {
                  grader.grade_rows(frame, first, end, rgb);
                }},
               head);
    return bytes.take();
  }
  GradedFrame graded = grader.grade(frame);
  FrameState dome = frame_state(show_, request.frame);
  change(request, dome);
  prepared_.overlays.clear();
  change_as_in_dome(grader, *renderer_, dome, graded);
  write_jpeg(bytes,
             {graded.width, graded.height,
              [&](int first, int end, unsigned short* rgb) {
                std::copy(graded.row(first), graded.row(end), rgb);
              }},
             head);
  return bytes.take();
}

}  // namespace domefall
