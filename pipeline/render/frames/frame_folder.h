// A FrameFolder is the folder of a show's frames.  It says where each frame lies, and has the
// record that says whose frames they are.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/image/frame_check.h"
#include "pipeline/render/frame_key.h"
#include "pipeline/show/show.h"

namespace domefall {

// An ExpectedFile is one that a folder of frames is to hold.
struct ExpectedFile {
  int frame = 0;
  std::filesystem::path path;
  std::string name;  // below the folder of the frames
  WantedFrame wanted;
  bool is_layer = false;  // and may well be black

  bool is_linear() const { return path.extension() == ".exr"; }
};

enum class FrameFiles { kAll, kGraded };  // all that the show keeps, or those alone that are graded

// Returns the folder of a show's frames, which is what --out says, or else out/NAME.
std::filesystem::path frames_folder(const Show& show, const std::string& out);

class FrameFolder {
 public:
  // The show, as large as it is rendered, must outlive this.
  FrameFolder(std::filesystem::path folder, const Show& show);

  const std::filesystem::path& path() const { return folder_; }
  // These are linear/NAME_00000.exr and graded/NAME_00000.png, by the show's FrameNames.  Where
  // those ask for folders, the file is linear/NAME_00000-09999/NAME_00000.exr.
  std::filesystem::path linear(int frame) const;
  std::filesystem::path graded(int frame) const;
  // These are lens/NAME_00000.exr and layers/LAYER/NAME_00000.exr, likewise.
  std::filesystem::path lens(int frame) const;
  std::filesystem::path layer(int frame, Layer layer) const;
  // Returns all files of a frame but its lens map.
  std::vector<std::filesystem::path> paths(int frame) const;
  bool has_linear() const { return show_.output.linear.has_value(); }
  bool has_graded() const { return show_.output.graded.has_value(); }
  // Returns the layers that have files of their own.
  std::vector<Layer> layers() const;

  // Returns what the file of the frame with this key has to be.
  WantedFrame wanted(std::string key) const;

  // Returns the files of these frames, each with the key that it has today.
  std::vector<ExpectedFile> files(const std::vector<int>& frames, const FrameKeys& keys,
                                  FrameFiles which = FrameFiles::kAll) const;

  // Throws InputError if there are frames in the folder and they belong to another show.  They do
  // if the folder's record gives another title, size or projection, or if another show's record
  // claims files with these names.  A folder without a record, or with one that cannot be
  // understood, belongs to nobody.
  void check_owner() const;

  // Returns the files among the frames that are not this show's, by their sorted paths below the
  // folder.  Such files have numbers beyond the show's end, or another name or kind.  Hidden files do not count.
  std::vector<std::string> foreign_files() const;

  // Says whether a path below the folder is that of one of the show's frames in a layer that the show
  // does not ask for.
  bool is_of_unasked_layer(const std::filesystem::path& file) const;

  // Makes the folders that files of these frames are to be put into, as make_folder().
  void prepare(const std::vector<int>& frames, bool for_lens_maps = false) const;

  // Writes the record, which belongs in a folder once a frame is there.  It depends on nothing but
  // the show and its size, so that any number of workers may write it at once.
  void write_record() const;

 private:
  void check_namesakes() const;
  std::filesystem::path record_path() const;
  std::string record() const;
  int frames_there() const;
  std::filesystem::path path_of(const std::string& kind, int frame, const char* extension) const;
  std::optional<int> frame_of(const std::filesystem::path& file) const;

  std::filesystem::path folder_;
  const Show& show_;
  std::string name_, file_name_;
};

}  // namespace domefall
