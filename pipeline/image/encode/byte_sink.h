// A ByteSink is where an encoder puts the bytes of a file.
#pragma once

#include <cstdint>
#include <string_view>

namespace domefall {

// A sink is not for two threads at once.  An encoder sees no errors of the disk.  Whoever gives the
// file its name throws them.
class ByteSink {
 public:
  ByteSink() = default;
  virtual ~ByteSink() = default;
  ByteSink(const ByteSink&) = delete;
  ByteSink(ByteSink&&) = delete;
  ByteSink& operator=(const ByteSink&) = delete;
  ByteSink& operator=(ByteSink&&) = delete;

  // Puts bytes at the position, which it moves behind the piece.
  virtual void write(std::string_view piece) noexcept = 0;
  virtual void seek(std::uint64_t position) noexcept = 0;
  virtual std::uint64_t position() const = 0;
};

}  // namespace domefall
