// Graded frames on the disk, for projectors and encoders: 16-bit RGB, PNG or TIFF by the path's
// extension (.png; .tif, .tiff).
//
// Lines of the file's description ("name: value") carry the fields of GradedInfo and the digest of
// the file (frame_seal.h).  The same frame has the same bytes wherever and whenever it is written.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "pipeline/image/frame_buffer.h"

namespace domefall {

struct GradedInfo {
  std::string key;  // digest of everything that decides this frame and its grade, hexadecimal
  std::string title;
  int frame = 0;
  std::string display, view;  // of the OpenColorIO configuration
  std::string software;
  std::string projection;
};

// Throws InputError for a name that is neither PNG nor TIFF by its extension.
void check_graded_name(const std::filesystem::path& path);

// A graded frame in the making, whose rows come from the top: no whole one need be in memory.
class GradedFile {
 public:
  // Throws InputError for another extension, and as TemporaryFile does.
  GradedFile(const std::filesystem::path& path, int width, int height, const GradedInfo& info);
  // Removes what was not finished.
  ~GradedFile();
  GradedFile(const GradedFile&) = delete;
  GradedFile(GradedFile&&) = delete;
  GradedFile& operator=(const GradedFile&) = delete;
  GradedFile& operator=(GradedFile&&) = delete;

  // How many rows at once are quickest to write.  Any other split gives the same bytes.
  static constexpr int kRows = 256;
  // rgb[count][width][3].
  void add(const unsigned short* rgb, int count);
  // Once all rows are there: gives the file its final name (atomic_file.h).  Throws as the
  // constructor.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// A frame that is whole, at once.  Throws as GradedFile.
void write_graded(const std::filesystem::path& path, const GradedFrame& frame,
                  const GradedInfo& info);

}  // namespace domefall
