// GradedFrames are the graded frames of a show that are made already.
#pragma once

#include <string>
#include <vector>

#include "pipeline/grade/grader.h"
#include "pipeline/image/frame_buffer.h"
#include "pipeline/image/graded_file.h"
#include "pipeline/render/frame_key.h"
#include "pipeline/render/frames/frame_folder.h"

namespace domefall {

// Returns what FrameKeys call the grading of a show, or an empty text without a grader.
std::string grade_id(const Show& show, const Grader* grader);

class GradedFrames {
 public:
  // The show, as large as its frames are, and its grader must outlive this.  Throws InputError if the
  // show keeps no graded frames.  Also throws as FrameKeys.
  GradedFrames(const Show& show, const Grader& grader, const std::filesystem::path& folder);

  std::filesystem::path file(int frame) const { return folder_.graded(frame); }
  const GradedFormat& format() const { return *show_.output.graded; }
  const Grader& grader() const { return grader_; }
  const std::string& show_digest() const { return keys_.show(); }

  // Returns what the file has to be.
  WantedFrame wanted(int frame) const { return folder_.wanted(key(frame)); }
  GradedInfo info(int frame) const;

  // Holds each file against its key and its digest.  Both exceptions name the frames in ranges, and
  // end in a hint.  Throws InputError if some are good ones of another size, show or kind.  Otherwise
  // throws TemporaryError if some are missing, damaged or of another version of the show.
  void check(const std::vector<int>& frames, int threads, const std::string& hint_for_others,
             const std::string& hint) const;

  // Returns the pixels.  Throws TemporaryError if the file is not good any more.
  GradedFrame read(int frame) const;

 private:
  std::string key(int frame) const;

  const Show& show_;
  FrameFolder folder_;
  const Grader& grader_;
  FrameKeys keys_;
};

// Returns how many frames of a show can be worked on at once within a gibibyte, which is at least
// one and at most `threads`.
int frames_at_once(const Show& show, int threads);

}  // namespace domefall
