// Files that appear whole or not at all.  Nothing half-written ever bears its final name, whatever
// kills the writer.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>

#include "pipeline/base/regular_file.h"
#include "pipeline/base/temporary_file.h"

namespace domefall {

// A ByteSink is where an encoder puts the bytes of a file.  It is not for two threads at once.  An
// encoder sees no errors of the disk.  Whoever gives the file its name throws them.
class ByteSink {
 public:
  ByteSink() = default;
  virtual ~ByteSink() = default;
  ByteSink(const ByteSink&) = delete;
  ByteSink& operator=(const ByteSink&) = delete;

  // Puts bytes at the position, which it moves behind the piece.
  virtual void write(std::string_view piece) noexcept = 0;
  virtual void seek(std::uint64_t position) noexcept = 0;
  virtual std::uint64_t position() const = 0;
};

// A NewFile is a file in the making that appears under its name when it is whole
// (temporary_file.h).  It is written piece by piece, so that no encoder needs the memory of all.
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

// Writes a file under a temporary name in the folder of `path` (temporary_file.h), flushes it to
// the disk, renames it to `path` and flushes the folder.  A file that was at `path` is there until
// the new one takes its place.  If anything fails, the temporary is removed and `path` is left as
// it was.  Throws as TemporaryFile does.
void write_atomically(const std::filesystem::path& path, std::string_view contents);

// A NewMappedFile is a file in the making, zeroed, that is written as memory, for what is larger
// than memory may be.
class NewMappedFile {
 public:
  // The disk's space is taken at once, so that a full disk is told here (TemporaryError) and not by
  // a signal later.  Throws as TemporaryFile does.
  NewMappedFile(const std::filesystem::path& path, std::size_t size);

  std::byte* data() { return static_cast<std::byte*>(memory_.get()); }
  std::size_t size() const { return memory_.get_deleter().bytes; }

  // Flushes the file to the disk and gives it its name, once.
  void commit();

 private:
  TemporaryFile file_;
  MappedMemory memory_;
};

}  // namespace domefall
