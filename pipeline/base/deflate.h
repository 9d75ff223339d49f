// Deflate (RFC 1951) is done by Intel's ISA-L at its level 1, in a quarter of zlib's time at the
// same size.  The bytes do not depend on the state of memory (see stream_memory() in deflate.cpp), and are the
// same on every x86-64 processor with SSE4.2, which all since 2009 have.  ISA-L finds repetitions
// by a hash that is this instruction's, and its ways for AVX2 and AVX-512 find the same ones.  Its
// levels 2 and above are no better for frames, and level 3 gives other bytes for other
// instructions.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/regular_file.h"

namespace domefall {

// A ByteBlock has bytes that can be resized without filling them.
class ByteBlock {
 public:
  // What was there is lost.
  void reserve(std::size_t capacity) {
    if (bytes_.size() < capacity) bytes_.resize(capacity);
  }
  std::size_t capacity() const { return bytes_.size(); }
  void set_size(std::size_t size) { size_ = size; }
  std::size_t size() const { return size_; }
  unsigned char* data() { return bytes_.data(); }
  std::string_view view() const { return {reinterpret_cast<const char*>(bytes_.data()), size_}; }

 private:
  std::vector<unsigned char> bytes_;
  std::size_t size_ = 0;
};

// A Deflater is the memory that one thread packs with.
class Deflater {
 public:
  Deflater();

  // Makes a whole zlib stream (RFC 1950).
  void pack_stream(std::string_view bytes, ByteBlock& out);

  // Makes a part of a stream, which ends at the end of a byte and does not refer to the parts
  // before it.  A stream is kStreamStart, any number of parts, kStreamEnd, and the Adler-32 sum of
  // all bytes.
  void pack_part(std::string_view bytes, ByteBlock& out);

 private:
  void pack(std::string_view bytes, bool whole, ByteBlock& out);

  MappedMemory stream_;
  std::vector<unsigned char> tables_;
};

inline constexpr std::string_view kStreamStart{"\x78\x01", 2}, kStreamEnd{"\x03\x00", 2};

// A gzip file (RFC 1952) begins with these bytes.
inline constexpr std::string_view kGzipStart{"\x1f\x8b", 2};

// Returns what a gzip file holds, which may have several members, but no more than its first `most`
// bytes.  Throws std::runtime_error, such as "is damaged", where these cannot be had.
std::string gunzip(std::string_view packed, std::size_t most);

// Returns the CRC-32 of RFC 1952, which PNG uses too, of bytes that follow those of `before`.
unsigned crc32_of(std::string_view bytes, unsigned before = 0);

// Returns RFC 1950's Adler-32, which begins with 1, of bytes that follow those of `before`.
unsigned adler32_of(std::string_view bytes, unsigned before = 1);

// Returns the Adler-32 of bytes whose sum is `first`, followed by `count` bytes whose own sum,
// counted from 1, is `second`.
unsigned adler32_joined(unsigned first, unsigned second, std::size_t count);

}  // namespace domefall
