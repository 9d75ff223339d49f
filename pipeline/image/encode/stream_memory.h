// StreamMemory is memory for ISA-L's isal_zstream, at an address that ISA-L's output does not
// depend on.
//
// ISA-L (2.30, igzip_icf_body_h1_gr_bt.asm, write_first_byte) hashes the third byte of a stream
// from a register that holds the address of the isal_zstream.  So position 2 is entered into the
// hash table at slot crc32c(address >> 16) instead of its own.  What is unpacked is right, since a
// repetition is compared before it is used.  But which ones are found depends on the address, and
// so do the bytes of about one block of pixels in a thousand.  An address whose slot is 0 makes all
// the same.
#pragma once

#include <cstddef>
#include <memory>

namespace domefall {

class StreamMemory {
 public:
  // Takes that many bytes, filled with 0.  Throws std::bad_alloc where there is no such place.
  explicit StreamMemory(std::size_t bytes);

  void* data() const { return place_.get(); }

 private:
  struct Unmap {
    std::size_t bytes = 0;
    void operator()(void* place) const;
  };
  std::unique_ptr<void, Unmap> place_;
};

}  // namespace domefall
