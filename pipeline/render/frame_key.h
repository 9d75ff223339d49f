// The key of a frame is a digest of all that its pixels depend on, and of nothing else.  So a
// change to one segment of a show leaves the frames of the other segments valid.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/base/digest.h"
#include "pipeline/render/file_stamp.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

class FrameKeys {
 public:
  // Reads the show's assets once, for their digests.  The show must outlive the keys.  `grade`
  // names the grading of frames (Grader::transform_id) and is empty where frames are not graded.
  // Throws InputError if an asset cannot be read.
  explicit FrameKeys(const Show& show, std::string grade = {});

  // Returns an asset that something has touched since its digest was taken, even if the content is
  // the same, or nothing if there is none.  Frames rendered meanwhile may not belong to these keys.
  std::optional<std::filesystem::path> touched_asset() const;
  // Says whether two sets of keys of one show saw assets of the same content.
  bool same_assets(const FrameKeys& other) const;

  // Returns the digest of what all frames share.  The timeline, and the skies that only some of the
  // frames see, do not enter it.
  const std::string& show() const { return common_; }
  // Returns the key of a scene-linear frame.  Throws as titles_key and overlays_key for a frame
  // with titles or overlays.
  std::string scene(const FrameState& state) const;
  // Returns the key of a layer's own file, of the frame with this key.
  static std::string layer(const std::string& scene_key, Layer layer);
  // Returns the key of the graded frame that is made from the frame with this key by the CDL of
  // this state.
  std::string graded(const std::string& scene_key, const FrameState& state) const;

 private:
  void stamp(const std::filesystem::path& file);
  void add_background(Digest& digest, const SkyBackground& background);
  void add_surface(Digest& digest, const Body& body);
  void add_bodies(Digest& digest);
  void add_sky(Digest& digest, const RegionSky& sky);
  void add_pattern_files(Digest& digest);
  void add_segments();
  // Returns the key of what is seen while the shutter is open, without titles and overlays.
  std::string exposed(const FrameState& state) const;
  // Returns the key of what is seen at one instant.
  std::string instant(const FrameState& state) const;

  const Show& show_;
  std::string common_;
  // These enter the keys of frames that can see these skies.
  std::string sky_three_, sky_four_, sky_next_;
  // backgrounds that segments have of their own, by the segment's index
  std::map<int, std::string> own_skies_;
  std::string grade_;
  std::vector<std::pair<std::filesystem::path, FileStamp>> assets_;
};

}  // namespace domefall
