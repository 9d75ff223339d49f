// The digest of a graded frame's pixels stands in the file before them, in a PNG, and is known after them:
// a place is kept for it and filled in at the end.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/image/new_file_stream.h"

namespace domefall {

// The file as OpenImageIO writes it, which sees where the description comes to stand.
class LateDigest : public NewFileProxy {
 public:
  explicit LateDigest(NewFile& file) : NewFileProxy(file) {}

  // The end of a description: a line break, "pixels: " and the digest's place.
  static std::string line();

  size_t write(const void* bytes, size_t count) override;

  // digest: Digest::hex().  Once the encoder has written all.  The checksum of a PNG's chunk follows.
  // Throws std::logic_error if the encoder did not write the description as it is.
  void fill_in(std::string_view digest);

 private:
  void fill_in_png(std::uint64_t place, std::string_view digest);

  void put(std::uint64_t place, std::string_view bytes);

  std::vector<std::uint64_t> places_;
  std::string head_;  // of a PNG, up to its pixels
  bool is_png_ = false, in_head_ = false;
};

}  // namespace domefall
