#include "pipeline/image/late_digest.h"

#include <boost/crc.hpp>
#include <stdexcept>

namespace domefall {
namespace {

constexpr std::string_view kStart = "\npixels: ", kPlace = "(this digest is to be filled in)";
static_assert(kPlace.size() == 32);

constexpr std::string_view kPng = "\x89PNG\r\n\x1a\n";
constexpr std::uint64_t kNumber = 4;  // bytes of a chunk's length, of its name, of its checksum

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::uint64_t k = 0; k < kNumber; ++k)
    value = value << 8 | static_cast<unsigned char>(bytes[k]);
  return value;
}

std::string in_big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

}  // namespace

std::string LateDigest::line() { return std::string(kStart) + std::string(kPlace); }

// Both libraries write a text at once; libtiff does so after the pixels.
void LateDigest::write(std::string_view piece) {
  const std::uint64_t at = file_.position();
  if (const auto found = piece.find(line()); found != std::string_view::npos)
    places_.push_back(at + found + kStart.size());
  if (at == 0) is_png_ = in_head_ = piece.starts_with(kPng);
  if (in_head_) head_ += piece;
  if (piece.find("IDAT") != std::string_view::npos) in_head_ = false;
  file_.write(piece);
}

void LateDigest::put(std::uint64_t place, std::string_view bytes) {
  file_.seek(place);
  file_.write(bytes);
}

// The PNG specification, 5.3: length of the data, name, data, CRC-32 of name and data.
void LateDigest::fill_in_png(std::uint64_t place, std::string_view digest) {
  head_.replace(place, digest.size(), digest);
  for (std::uint64_t chunk = kPng.size(); chunk + 2 * kNumber <= head_.size();) {
    const std::uint64_t name = chunk + kNumber, data = name + kNumber,
                        end = data + big_endian(std::string_view(head_).substr(chunk));
    if (place > data && place < end && end <= head_.size()) {
      boost::crc_32_type checksum;
      checksum.process_bytes(head_.data() + name, end - name);
      put(place, digest);
      return put(end, in_big_endian(checksum.checksum()));
    }
    chunk = end + kNumber;
  }
  throw std::logic_error("a PNG without a chunk that holds its description");
}

void LateDigest::fill_in(std::string_view digest) {
  const std::uint64_t end = file_.size();
  if (places_.empty() && !file_.failed())
    throw std::logic_error("a graded file without its description");
  for (const std::uint64_t place : places_)
    is_png_ ? fill_in_png(place, digest) : put(place, digest);
  file_.seek(end);
}

}  // namespace domefall
