// LivePictures are the pictures of one show for the clients of the live preview, made by the show's
// own renderer and grade.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "pipeline/grade/grader.h"
#include "pipeline/program/preview/picture_request.h"
#include "pipeline/render/overlay/star_labels.h"
#include "pipeline/render/renderer.h"

namespace domefall {

struct LivePicture {
  std::string jpeg;
  FrameState state;  // with the camera and the projection of the picture
};

// A LivePictures is not for two threads at once.
class LivePictures {
 public:
  // `threads` is as Renderer has it.  Throws as Grader and Renderer.
  LivePictures(Show show, int threads);
  ~LivePictures();
  LivePictures(const LivePictures&) = delete;
  LivePictures& operator=(const LivePictures&) = delete;

  // Returns the show as the file has it, whatever was asked for.
  const Show& show() const { return show_; }
  // These are the display and the view where a request names none.
  const std::string& display() const { return usual_.display(); }
  const std::string& view() const { return usual_.view(); }
  int threads() const { return renderer_->threads(); }

  // Takes another version of the show.  Skies that it leaves as they are stay loaded.  Throws as
  // the constructor, and then keeps the version before.
  void take(Show show);

  // Returns the state of the picture that is asked for.  Throws InputError where the show cannot be
  // seen so.
  FrameState state_for(const PictureRequest& request) const;

  // Makes the picture.  Throws as Renderer::render, throws RenderStopped soon after `stop` becomes
  // true, and throws InputError for a display or a view that is not there.
  LivePicture make(const PictureRequest& request, const std::atomic<bool>& stop);

  // Returns what a request sees along the light of one pixel, and the star that is seen near it, as
  // JSON.
  std::string probe(const PictureRequest& request, PixelPosition at);

 private:
  // Sets the show as a request wants it, for the renderer, which reads it anew for each frame.
  void prepare(const PictureRequest& request);
  const Grader& grader_for(const PictureRequest& request);
  // Begins to make the table of the usual grade, on a thread of its own.
  void make_table();
  void wait_for_tables();
  std::string encoded(const PictureRequest& request, const FrameState& state,
                      const HalfFrame& frame);

  int wanted_threads_;
  Show show_;      // as the file has it
  Show prepared_;  // what the renderer reads
  Grader usual_;
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<StarLabels> labels_;
  std::map<std::pair<std::string, std::string>, Grader> others_;  // by display and view
  // This becomes true once the table of the usual grade is made, and is null until that has begun.
  std::shared_ptr<std::atomic<bool>> table_made_;
  std::vector<std::thread> making_tables_;
  HalfFrame frame_;
};

}  // namespace domefall
