// An OpenEXR file in memory, so that what reaches the disk is written, flushed and renamed by
// atomic_file, and a full disk is told by the system.
#pragma once

#include <OpenEXR/ImfIO.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace domefall {

class MemoryStream : public Imf::OStream {
 public:
  explicit MemoryStream(const std::string& name) : Imf::OStream(name.c_str()) {}

  void write(const char c[], int n) override {
    const auto count = static_cast<std::size_t>(n);
    const std::size_t over = std::min(contents_.size() - at_, count);
    contents_.replace(at_, over, c, over);
    contents_.append(c + over, count - over);
    at_ += count;
  }
  uint64_t tellp() override { return at_; }
  // Within what was written: OpenEXR goes back to fill in its offset table, and to the end again.
  void seekp(uint64_t position) override { at_ = static_cast<std::size_t>(position); }

  std::string_view contents() const { return contents_; }

 private:
  std::string contents_;
  std::size_t at_ = 0;
};

}  // namespace domefall
