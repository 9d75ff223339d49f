// These files are written piece by piece while they are made, so that no encoder needs the memory
// of a whole one.  new_mapped_file.h writes them as memory.
#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>

#include "pipeline/image/encode/byte_sink.h"
#include "pipeline/image/temporary_file.h"

namespace domefall {

// A NewFile is a file in the making that appears under its name when it is whole
// (temporary_file.h).
class NewFile : public ByteSink {
 public:
  // Throws as TemporaryFile does.
  explicit NewFile(const std::filesystem::path& path) : file_(path) {}

  // Encoders that call these expect no exceptions.  After an error, which commit() throws, what is
  // written goes nowhere.  They are not for two threads at once.
  void write(std::string_view piece) noexcept override;
  void seek(std::uint64_t position) noexcept override;
  std::uint64_t position() const override { return written_to_ + pending_.size(); }
  std::uint64_t size() const { return std::max(size_, position()); }
  bool failed() const { return error_ != nullptr; }

  // Hands all that was written to the system, and returns the descriptor by which it can be read.
  int flush() noexcept;

  // Flushes the file to the disk and gives it its name, once.  Throws as the constructor.
  void commit();

 private:
  void write_pending() noexcept;

  TemporaryFile file_;
  std::string pending_;  // to be written at written_to_
  std::uint64_t written_to_ = 0, size_ = 0;
  std::exception_ptr error_;
};

}  // namespace domefall
