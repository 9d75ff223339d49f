// A MemoryFile is a file in memory, for what another program or library reads from a file, or
// writes to one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "pipeline/image/descriptor.h"

namespace domefall {

// It has no name in any folder and is gone with its users, so that nothing is left behind, however
// the program ends.
class MemoryFile {
 public:
  // `purpose` is what errors call it.  Throws TemporaryError if there is no memory for it.
  explicit MemoryFile(const std::string& purpose);

  // Both functions throw TemporaryError.
  void append(std::string_view bytes) const;
  void rewind() const;

  // Returns all that the file holds, whoever wrote it.
  std::string contents() const;

  // Returns the descriptor, which programs that this one starts do not inherit unless they are
  // given it.
  int number() const { return descriptor_.number(); }
  // Returns a path under which this process and those that inherit the descriptor may open it.
  std::string path() const;

 private:
  std::string purpose_;
  Descriptor descriptor_;
};

}  // namespace domefall
