// A body that moves while a frame's light is gathered is drawn as a trail, at the places from which
// its light is seen then.
//
// With an open shutter each instant of the frame stands for its share of the time, and a body that
// moves by more than a pixel or so meanwhile is drawn at all of that time's places.  Behind the hole
// the images of a body race around the Einstein ring, as those of a star do (star_trail.h).  There an
// image is the mean over the same window of time as a star's.  It stays where the hole is at the
// instant, however the camera turns.
//
// About a hole that spins there is no axis, and images have no orders: they come and go in pairs on
// caustics.  There all images of a body together are the mean over the time from the frame before to the
// next one, as those of a star are.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "pipeline/render/scene/body_sight.h"
#include "pipeline/render/scene/frame_scene.h"

namespace domefall {

// A BodyTrails finds trails of the bodies of one scene.
class BodyTrails {
 public:
  // The scene must outlive this object.
  explicit BodyTrails(const FrameScene& scene);

  // The sight of the scene's own instant.
  const BodySight& sight() const { return now_; }

  // A Piece is a part of a trail in the tetrad of the scene's instant.
  struct Piece {
    SkyImage image;
    double psi;              // BodyImage::way
    double solid_angle = 0;  // BodySight::Piece's, as the mean over the time
    WorkingRgb tint{1, 1, 1};
  };
  // Returns the pieces of the trail of one order, or nothing where the body is seen at the instant
  // alone.  `image` is the image at the instant.  The amplifications of all pieces together are the
  // mean over the time of the trail, to 1e-3.
  std::vector<Piece> trail(const Body& body, int order, const BodySight::Image& image);

  // Returns the pieces of all images of a body, of a lens that lists them, or nothing where none is so
  // bright and fast that it is more than an instant's.
  std::vector<Piece> listed_trail(const Body& body);

 private:
  // A Moment is a sight of bodies at another instant.
  struct Moment {
    Moment(const FrameScene& scene, double frames, CameraMotion camera);
    FrameState state;
    BodySight sight;
  };
  // A Window is the time that a trail is the mean of, in frames from the scene's instant.  The weight
  // is that of a PassageWindow, which may reach beyond [begin, end].
  struct Window {
    double begin, end, half, sharpness;
    CameraMotion camera;
    double nearest = 0;                             // when the body passes the axis
    double weight(double from, double to) const;    // its integral
    double share_of(double from, double to) const;  // of all light
  };
  // A Node is an image at one time of a window.
  struct Node {
    double frames;
    const BodySight* sight;
    std::optional<BodySight::Image> image;
    CameraDirection seen{V3d(0, 0, 0)};
    double flux = 0;
    V3d off_axis{0, 0, 0};  // component of the body's direction across the axis of the lens
  };
  // A Passage is how far the body's direction is from the axis of the lens, as a sine, by how much it
  // moves from frame to frame, and after how many frames it is nearest to the axis.
  struct Passage {
    double sine, way, nearest;
  };
  struct Trail {
    const Body& body;
    int order;
    Window window;
    double sources_step;  // a source that moves by less across the axis counts as standing
    std::vector<Piece> pieces{};
  };

  const Moment& moment_at(double frames, CameraMotion camera);
  // `emitted` is a time near which the light may have left the body (BodySight::image).
  Node node(const Body& body, int order, double frames, CameraMotion camera,
            const std::optional<double>& emitted = {});
  Node node_within(const Body& body, int order, double frames, CameraMotion camera);
  double way_of(const Body& body, double r);
  std::optional<Passage> passage_of(const Body& body, int order);
  std::optional<Window> passage_window_of(const Body& body, int order, const BodyImage& image);
  std::optional<Window> open_window_of(const Body& body, int order);
  bool is_one(const Trail& trail, const Node& a, const Node& b) const;
  void divide(Trail& trail, const Node& a, const Node& b, int depth);
  void add_piece(Trail& trail, const Node& node, double share) const;

  const FrameScene& scene_;
  BodySight now_;
  std::map<std::pair<double, CameraMotion>, std::unique_ptr<const Moment>> moments_;
};

}  // namespace domefall
