// The digest of a graded frame's pixels stands before them in a PNG and is known after them.  So a
// place is kept for it, which is filled in at the end.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/image/image_formats.h"
#include "pipeline/image/new_file.h"

namespace domefall {

// The file as the encoder writes it; this class notes where the encoder puts the description.
class LateDigest : public ImageSink {
 public:
  explicit LateDigest(NewFile& file) : file_(file) {}

  // The end of a description: a line break, "pixels: " and the digest's place.
  static std::string line();

  void write(std::string_view piece) override;
  void seek(std::uint64_t position) override { file_.seek(position); }
  std::uint64_t position() const override { return file_.position(); }
  std::uint64_t size() const override { return file_.size(); }

  // Puts Digest::hex() in its place, and the new checksum after a PNG's chunk, once the encoder has
  // written all.  Throws std::logic_error if the encoder did not write the description as it is.
  void fill_in(std::string_view digest);

 private:
  void fill_in_png(std::uint64_t place, std::string_view digest);

  void put(std::uint64_t place, std::string_view bytes);

  NewFile& file_;
  std::vector<std::uint64_t> places_;
  std::string head_;  // of a PNG, up to its pixels
  bool is_png_ = false, in_head_ = false;
};

}  // namespace domefall
