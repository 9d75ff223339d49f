#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/render/blobs/ellipse_blob.h"
#include "pipeline/render/blobs/metric_shape.h"

namespace domefall {
namespace {

constexpr std::size_t kPlacedAtOnce = 32;
// A wide ellipse may err by this pixel value where its relative error exceeds that of other
// ellipses.
constexpr double kMostWideError = 5e-4;
constexpr int kNowhere = static_cast<int>(BlobKind::kNowhere),
              kEllipse = static_cast<int>(BlobKind::kEllipse),
              kCap = static_cast<int>(BlobKind::kCap);

// An ImagePlane holds what the loop needs to know about the frame.
struct ImagePlane {
  double unit;  // the argument of blob_shape()
  double middle_x, middle_y, width, height;
  double most_peak;
};

// An ellipse that is placed by the metric has at most this scale_change.  Its error, up to 3.6e-3
// of the peak, is three times that of other ellipses, because the caps that it replaces cost more.
constexpr double kMostScaleChangeByMetric = 0.006;
// Up to this scale_change a faint ellipse keeps its light, to 1e-3.
constexpr double kMostFaintScaleChange = 0.03;
// Farther from the image than this (pixels) no ellipse is tried.
constexpr double kFarBeside = 1e5;

// A Placing is a batch of images, stored column by column, with what becomes of them.
struct Placing {
  alignas(64) std::array<double, kPlacedAtOnce> x, y, red, green, blue, sigma;
  alignas(64) std::array<float, kPlacedAtOnce> xx, xy, yy, peak_per_flux;
  alignas(64) std::array<int, kPlacedAtOnce> kind, first_row;
};

// Sets what becomes of the k-th image.  Its blob has the shape s, or is a cap if it is `far`.  The
// choices are selections and not branches, so that loops over this function become SIMD code.
[[gnu::always_inline]] inline void place_one(const ImagePlane& plane, const BlobShape& s, bool far,
                                             double most_scale_change, std::size_t k, Placing& p) {
  const double warm = p.red[k] > p.green[k] ? p.red[k] : p.green[k];
  const double brightest = warm > p.blue[k] ? warm : p.blue[k];
  const BlobScale scale = blob_scale(s, brightest);
  // The ellipse ends where d P d = -2 ln(cut).  The factor is 1 % larger, because drawing takes a
  // logarithm that is up to 1 % larger.
  const double q = -2.02 * logarithm(scale.cut);
  const double half_x = std::sqrt(q * s.spread_x), half_y = std::sqrt(q * s.spread_y);
  const double half = half_x > half_y ? half_x : half_y;
  const double from_left = p.x[k] + half_x, from_top = p.y[k] + half_y;
  const double to_right = plane.width - 1 - (p.x[k] - half_x);
  const double to_bottom = plane.height - 1 - (p.y[k] - half_y);
  const double across = from_left < to_right ? from_left : to_right;
  const double down = from_top < to_bottom ? from_top : to_bottom;
  int kind = brightest * scale.peak_per_flux > plane.most_peak ? kCap : kEllipse;
  kind = s.scale_change > most_scale_change ? kCap : kind;
  kind = 2 * half > kMostEllipsePixels - 1 ? kCap : kind;
  kind = (across < down ? across : down) < 0 ? kNowhere : kind;
  p.kind[k] = far ? kCap : kind;
  p.first_row[k] = static_cast<int>(p.y[k] - half_y + 64) - 64;  // rounded down
  p.xx[k] = static_cast<float>(s.xx);
  p.xy[k] = static_cast<float>(s.xy);
  p.yy[k] = static_cast<float>(s.yy);
  p.peak_per_flux[k] = static_cast<float>(scale.peak_per_flux);
}

template <bool kDome>
[[gnu::always_inline]] inline void place_loop(const ImagePlane& plane, Placing& p) {
  for (std::size_t k = 0; k < kPlacedAtOnce; ++k) {
    const double cx = p.x[k] - plane.middle_x, cy = p.y[k] - plane.middle_y;
    // Far outside the half sphere ellipses grow without bound, so caps are drawn there.
    const bool far = kDome && plane.unit * plane.unit * (cx * cx + cy * cy) > 3;
    const BlobShape s = blob_shape<kDome>(plane.unit, far ? 0 : cx, far ? 0 : cy, p.sigma[k]);
    place_one(plane, s, far, kMostScaleChange, k, p);
  }
}
Dispatched<place_loop<true>> place_on_dome;
Dispatched<place_loop<false>> place_on_flat;

// Says whether an ellipse is so long and so slanted that the factors exp(-P_xy x y) by which it is
// drawn might leave the range of floats.  The brightest ellipses end at q = 20, so that x reaches
// sqrt(40 P_yy/det P), and y the same with P_xx.  With c^2 = P_xy^2/(P_xx P_yy) the exponent is
// then at most 40 c/(1 - c^2).  The limit c = 1/2 keeps it below 27.
bool is_slanted(const BlobShape& s) { return s.xy * s.xy > 0.25 * s.xx * s.yy; }

// Places a batch by the projection's metric.  Where the scale changes quickly, an ellipse may
// replace a blob that is so faint that nobody sees the error.
void place_by_metric(const Projection& projection, const ImagePlane& plane, Placing& p) {
  for (std::size_t k = 0; k < kPlacedAtOnce; ++k) {
    p.kind[k] = kCap;
    p.first_row[k] = 0;
    p.xx[k] = p.xy[k] = p.yy[k] = p.peak_per_flux[k] = 0;
    if (!(std::abs(p.x[k]) < kFarBeside && std::abs(p.y[k]) < kFarBeside)) continue;
    const PixelPosition at{p.x[k] + 1, p.y[k] + 1};
    const CameraDirection n = direction_at(projection, at);
    if (!(scale_change_per_radian(projection, n) * p.sigma[k] < kMostFaintScaleChange)) continue;
    const BlobShape s = blob_shape(projection, pixel_metric(projection, at), n, p.sigma[k]);
    if (is_slanted(s)) continue;
    const double peak = std::max({p.red[k], p.green[k], p.blue[k]}) / s.solid_angle;
    const bool faint = 0.6 * s.scale_change * peak <= kMostWideError;
    place_one(plane, s, false, faint ? kMostFaintScaleChange : kMostScaleChangeByMetric, k, p);
  }
}

// Places a batch.  If it has fewer than kPlacedAtOnce images, its last image fills the rest.
void place_batch(const Projection& projection, const ImagePlane& plane, const StarImage* images,
                 const double* sigma, std::size_t count, EllipseBlob* blobs, int* first_row,
                 BlobKind* kind) {
  Placing p;
  for (std::size_t k = 0; k < kPlacedAtOnce; ++k) {
    const StarImage& image = images[std::min(k, count - 1)];
    p.x[k] = image.x;
    p.y[k] = image.y;
    p.sigma[k] = sigma[std::min(k, count - 1)];
    p.red[k] = image.rgb[0];
    p.green[k] = image.rgb[1];
    p.blue[k] = image.rgb[2];
  }
  if (!has_blob_loops(projection))
    place_by_metric(projection, plane, p);
  else if (is_domemaster(projection))
    place_on_dome(plane, p);
  else
    place_on_flat(plane, p);
  for (std::size_t k = 0; k < count; ++k) {
    const StarImage& image = images[k];
    const float scale = p.peak_per_flux[k];
    blobs[k] = {image.x, image.y,
                p.xx[k], p.xy[k],
                p.yy[k], {image.rgb[0] * scale, image.rgb[1] * scale, image.rgb[2] * scale}};
    first_row[k] = p.first_row[k];
    kind[k] = static_cast<BlobKind>(p.kind[k]);
  }
}

std::optional<BlobShape> wide_shape(const Projection& projection, const CapBlob& cap) {
  const double sigma = cap.sigma, width = columns(projection);
  if (!has_blob_loops(projection)) {
    const PixelPosition at{cap.x + 1.0, cap.y + 1.0};
    const CameraDirection n = direction_at(projection, at);
    // Only the smaller ellipses are copied to the other side of a seam (BlobLayer).
    const bool on_seam =
        traits_of(projection).has_seam && !(cap.x > cap.reach && cap.x + cap.reach < width - 1);
    if (on_seam || !(scale_change_per_radian(projection, n) * sigma < kMostFaintScaleChange))
      return std::nullopt;
    const BlobShape s = blob_shape(projection, pixel_metric(projection, at), n, sigma);
    return is_slanted(s) ? std::nullopt : std::optional(s);
  }
  const bool dome = is_domemaster(projection);
  const double cx = cap.x - (width - 1) / 2.0, cy = cap.y - (rows(projection) - 1) / 2.0;
  const double unit = largest_pixel_angle(projection) / (dome ? 1 : 2);
  if (!dome) return blob_shape<false>(unit, cx, cy, sigma);
  if (unit * std::hypot(cx, cy) > 1.7) return std::nullopt;
  return blob_shape<true>(unit, cx, cy, sigma);
}

}  // namespace

void place_ellipses(const Projection& projection, const StarImage* images, const double* sigma,
                    std::size_t count, double most_peak, EllipseBlob* blobs, int* first_row,
                    BlobKind* kind) {
  const bool dome = is_domemaster(projection);
  const double width = columns(projection), height = rows(projection);
  const double unit = largest_pixel_angle(projection) / (dome ? 1 : 2);
  const ImagePlane plane{unit, (width - 1) / 2, (height - 1) / 2, width, height, most_peak};
  for (std::size_t k = 0; k < count; k += kPlacedAtOnce)
    place_batch(projection, plane, images + k, sigma + k, std::min(kPlacedAtOnce, count - k),
                blobs + k, first_row + k, kind + k);
}

bool place_wide_ellipse(const Projection& projection, const CapBlob& cap, double most_peak,
                        EllipseBlob& ellipse) {
  if (2 * cap.reach > kMostWideEllipsePixels) return false;
  const std::optional<BlobShape> s = wide_shape(projection, cap);
  if (!s) return false;
  const double peak = double{cap.peak_per_flux} * std::max({cap.rgb[0], cap.rgb[1], cap.rgb[2]});
  if (peak > most_peak ||
      (s->scale_change > kMostScaleChange && 0.6 * s->scale_change * peak > kMostWideError))
    return false;
  ellipse = {cap.x,
             cap.y,
             static_cast<float>(s->xx),
             static_cast<float>(s->xy),
             static_cast<float>(s->yy),
             {cap.rgb[0] * cap.peak_per_flux, cap.rgb[1] * cap.peak_per_flux,
              cap.rgb[2] * cap.peak_per_flux}};
  return true;
}

}  // namespace domefall
