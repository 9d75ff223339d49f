#include "pipeline/render/blobs/blob_layer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <tuple>

#include "pipeline/render/blobs/metric_shape.h"

namespace domefall {
namespace {

// One task places this many images, whatever the number of threads.  Within a task, this many parts
// of images are placed at once.
constexpr std::size_t kTask = 32768, kPartsAtOnce = 256;

// Splats are quicker where a frame has more than one image for this many pixels, as measured at 4k.
constexpr double kPixelsPerSplat = 32;
// The brightest peak of a splat, as a pixel value, where blobs are smallest.  The blur of splats
// ends at e^-10 of its peak (kTapSigmas), which for this peak is about kUnseen.  A brighter splat
// would end visibly.
constexpr double kBrightestSplat = 1;

// Returns the most light that the brightest channel of a splat may have.  A Gaussian of width sigma
// has the peak light/(2 pi sigma^2).
float brightest_splat(const PointSpread& widths) {
  const double peak = std::min(kBrightestSplat, most_coloured_peak(widths.paling()));
  return static_cast<float>(std::min(
      widths.single_blob_light(), peak * 2 * std::numbers::pi * widths.least() * widths.least()));
}

// An image has one middle and at most this many parts in all.
constexpr std::size_t kMostParts = 1 + std::tuple_size_v<decltype(PointSpreadParts::halo)>;

StarImage with_share(const StarImage& image, double share) {
  const auto part = static_cast<float>(share);
  return {image.x, image.y, {image.rgb[0] * part, image.rgb[1] * part, image.rgb[2] * part}};
}

// An ellipse touches at most this many bands: n rows touch (n + 2 b - 2)/b bands of b rows if they
// begin with the last row of a band.
constexpr int kMostBands = (kMostEllipsePixels + 2 * kBandRows - 2) / kBandRows;

std::array<ColumnRange, kBandRows> columns_inside(const Projection& projection, int first,
                                                  int count) {
  std::array<ColumnRange, kBandRows> inside;
  for (int k = 0; k < count; ++k)
    inside[static_cast<std::size_t>(k)] = inside_columns(projection, first + k);
  return inside;
}

}  // namespace

void BlobLayer::Task::clear() {
  ellipses.clear();
  band.clear();
  last_band.clear();
  caps.clear();
  splats.images.clear();
  splats.first.clear();
  size = 0;
}

void BlobLayer::start(const Projection& projection) {
  projection_ = projection;
  bands_ = static_cast<std::size_t>((rows(projection) + kBandRows - 1) / kBandRows);
  splat_buckets_.reset();
  for (Task& task : tasks_) task.clear();
  used_ = size_ = 0;
  caps_.clear();
}

bool BlobLayer::are_many(double images, const Projection& projection) {
  return images * kPixelsPerSplat > static_cast<double>(columns(projection)) * rows(projection);
}

void BlobLayer::use_splats(const PointSpread& widths) {
  if (!has_blob_loops(projection_)) return;
  splat_buckets_.emplace(projection_, widths.least());
  if (!splat_buckets_->usable()) splat_buckets_.reset();
}

// ---- placing ----

std::size_t BlobLayer::new_tasks(std::size_t count) {
  const std::size_t before = used_;
  used_ += count;
  if (tasks_.size() < used_) tasks_.resize(used_);
  return before;
}

void BlobLayer::place(std::size_t number, std::vector<StarImage>& images,
                      const PointSpread& widths) {
  Task& task = tasks_[number];
  std::size_t others = images.size();
  if (splat_buckets_) {
    others = splat_buckets_->sort(images, brightest_splat(widths), task.splats);
    task.size += task.splats.images.size();
  }
  place_blobs(images.data(), others, widths, task);
}

// The parts of images that are placed at once are the middles of the images and the Gaussians of
// their halos.
struct BlobLayer::Parts {
  std::array<StarImage, kPartsAtOnce> image;
  std::array<double, kPartsAtOnce> sigma;
  std::array<bool, kPartsAtOnce> is_middle;
  std::size_t count = 0;

  void add(const StarImage& part, double width, bool middle) {
    image[count] = part, sigma[count] = width, is_middle[count] = middle;
    ++count;
  }
};

// Places an image as a cap.  Returns false if nothing of it is in the frame.
bool BlobLayer::place_one_cap(const StarImage& image, double sigma, float paling,
                              Task& task) const {
  CapBlob cap{image.x,
              image.y,
              static_cast<float>(sigma),
              {image.rgb[0], image.rgb[1], image.rgb[2]},
              paling};
  const bool seen = place_cap(projection_, cap);
  if (seen) task.caps.push_back(cap);
  return seen;
}

void BlobLayer::place_one_ellipse(const EllipseBlob& ellipse, int first_row, Task& task) const {
  task.ellipses.push_back(ellipse);
  const int band = std::max(first_row, 0) / kBandRows;
  task.band.push_back(static_cast<std::uint16_t>(band));
  // The ellipse reaches as far below its middle as above.  Two more rows make up for rounding.
  const auto last_row = static_cast<int>(2 * ellipse.y) - first_row + 2;
  int& last = task.last_band[static_cast<std::size_t>(band)];
  last = std::max(last, last_row / kBandRows);
}

// On an image of the whole sphere an ellipse continues beyond the seam at the left and right edge.
// A copy that is shifted by the image's width draws the part on the other side.
void BlobLayer::place_with_copies(const EllipseBlob& ellipse, int first_row, Task& task) const {
  place_one_ellipse(ellipse, first_row, task);
  if (!traits_of(projection_).has_seam) return;
  const auto width = static_cast<float>(columns(projection_));
  for (const float shift : {-width, width}) {
    EllipseBlob copy = ellipse;
    copy.x += shift;
    if (copy.x > -kMostEllipsePixels && copy.x < width + kMostEllipsePixels)
      place_one_ellipse(copy, first_row, task);
  }
}

void BlobLayer::place_parts(const Parts& parts, const PointSpread& widths, Task& task) const {
  std::array<EllipseBlob, kPartsAtOnce> ellipses;
  std::array<int, kPartsAtOnce> first_row;
  std::array<BlobKind, kPartsAtOnce> kind;
  place_ellipses(projection_, parts.image.data(), parts.sigma.data(), parts.count,
                 most_coloured_peak(widths.paling()), ellipses.data(), first_row.data(),
                 kind.data());
  for (std::size_t k = 0; k < parts.count; ++k) {
    bool seen = kind[k] == BlobKind::kEllipse;
    if (seen)
      place_with_copies(ellipses[k], first_row[k], task);
    else if (kind[k] == BlobKind::kCap)
      seen = place_one_cap(parts.image[k], parts.sigma[k], widths.paling(), task);
    // Only middles are counted, so that an image with a halo counts once.
    task.size += seen && parts.is_middle[k] ? 1 : 0;
  }
}

void BlobLayer::place_blobs(const StarImage* images, std::size_t count, const PointSpread& widths,
                            Task& task) const {
  Parts parts;
  task.ellipses.reserve(count);
  task.band.reserve(count);
  task.last_band.resize(bands_, 0);
  for (std::size_t k = 0; k < count; ++k) {
    const StarImage& image = images[k];
    // An image this faint, as nearly all are, is a single blob of the least width.
    if (std::max({image.rgb[0], image.rgb[1], image.rgb[2]}) <= widths.single_blob_light()) {
      parts.add(image, widths.least(), true);
    } else {
      const PointSpreadParts of_image = widths.parts(image);
      parts.add(of_image.image, of_image.sigma, true);
      for (const PointSpreadParts::Halo& halo : of_image.halo)
        if (halo.share > 0) parts.add(with_share(image, halo.share), halo.sigma, false);
    }
    if (parts.count + kMostParts > kPartsAtOnce || k + 1 == count) {
      place_parts(parts, widths, task);
      parts.count = 0;
    }
  }
}

void BlobLayer::add(const std::vector<StarImage>& images, const PointSpread& widths) {
  const std::size_t count = (images.size() + kTask - 1) / kTask, before = new_tasks(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t t) {
    // place() rearranges its list, so each task works on a copy.
    const auto first = images.begin() + static_cast<std::ptrdiff_t>(t * kTask);
    const auto left = static_cast<std::size_t>(images.end() - first);
    std::vector<StarImage> own(first, first + static_cast<std::ptrdiff_t>(std::min(kTask, left)));
    place(before + t, own, widths);
  });
}

void BlobLayer::add(const std::vector<CapBlob>& caps) {
  Task& task = tasks_[new_tasks(1)];
  task.caps = caps;
  task.size = caps.size();
}

// ---- drawing ----

void BlobLayer::draw_splats(int band, SplatBuffer& buffer, float* rgb) const {
  const int first = band * kBandRows, count = std::min(kBandRows, rows(projection_) - first);
  const int end_bucket = splat_buckets_->last_bucket(first + count - 1) + 1;
  const auto before = [this](int bucket) { return first_splat_[static_cast<std::size_t>(bucket)]; };
  // Where no splat reaches the band, nothing is dropped or blurred, and the buffer starts anew
  // behind the gap.
  if (before(splat_buckets_->first_bucket(first)) == before(end_bucket)) {
    buffer.start(*splat_buckets_);
    return;
  }
  buffer.advance(first);
  std::vector<SplatBuffer::Splats> lists;
  while (buffer.next_bucket() < end_bucket) {
    const auto bucket = static_cast<std::size_t>(buffer.next_bucket());
    lists.clear();
    for (std::size_t t = 0; t < used_; ++t) {
      const SplatList& splats = tasks_[t].splats;
      if (!splats.images.empty())
        lists.push_back({splats.images.data() + splats.first[bucket],
                         splats.first[bucket + 1] - splats.first[bucket]});
    }
    buffer.drop(lists);
  }
  buffer.add_band(first, count, columns_inside(projection_, first, count).data(), rgb);
}

void BlobLayer::draw_wide(const std::vector<std::uint32_t>& numbers, const Canvas& canvas) const {
  constexpr std::size_t kGathered = 32;
  std::array<EllipseBlob, kGathered> gathered;
  for (std::size_t begin = 0; begin < numbers.size(); begin += kGathered) {
    const std::size_t count = std::min(kGathered, numbers.size() - begin);
    for (std::size_t k = 0; k < count; ++k) gathered[k] = wide_[numbers[begin + k]];
    draw_wide_ellipses(gathered.data(), count, canvas);
  }
}

// Ellipses are sorted by their first band, so those that reach this band lie in one stretch of
// memory.  Earlier bands none of whose ellipses reach this one are skipped.
std::span<const EllipseBlob> BlobLayer::ellipses_of(int band) const {
  const auto own = static_cast<std::size_t>(band);
  auto begin = static_cast<std::size_t>(std::max(0, band - kMostBands + 1));
  while (begin < own && last_band_[begin] < band) ++begin;
  return {ellipses_.get() + first_ellipse_[begin], ellipses_.get() + first_ellipse_[own + 1]};
}

bool BlobLayer::reaches(int band) const {
  const auto own = static_cast<std::size_t>(band);
  return splat_buckets_ || !ellipses_of(band).empty() || !wide_of_band_[own].empty() ||
         !caps_of_band_[own].empty();
}

// The canvas writes to rgb.  NOLINTNEXTLINE(readability-non-const-parameter)
void BlobLayer::draw_band(int band, SplatBuffer& buffer, float* rgb) const {
  if (splat_buckets_) draw_splats(band, buffer, rgb);
  const int first = band * kBandRows, count = std::min(kBandRows, rows(projection_) - first);
  const auto inside = columns_inside(projection_, first, count);
  const Canvas canvas{rgb, columns(projection_), first, count, inside.data()};
  const auto own = static_cast<std::size_t>(band);
  const std::span<const EllipseBlob> ellipses = ellipses_of(band);
  draw_ellipses(ellipses.data(), ellipses.size(), canvas);
  draw_wide(wide_of_band_[own], canvas);
  for (const std::uint32_t k : caps_of_band_[own]) draw_cap(caps_[k], projection_, canvas);
}

}  // namespace domefall
