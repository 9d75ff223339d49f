#include "pipeline/render/cryptomatte.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>

namespace domefall {
namespace {

constexpr const char* kLayer = "CryptoObject";
constexpr std::size_t kMostRanks = 6;

// MurmurHash3 for x86, 32 bits, seed 0.
std::uint32_t murmur_hash(const std::string& text) {
  const auto byte = [&](std::size_t k) {
    return std::uint32_t{static_cast<unsigned char>(text[k])};
  };
  const auto mixed = [](std::uint32_t k) { return std::rotl(k * 0xcc9e2d51u, 15) * 0x1b873593u; };
  std::uint32_t hash = 0;
  std::size_t at = 0;
  for (; at + 4 <= text.size(); at += 4) {
    const std::uint32_t block =
        byte(at) | byte(at + 1) << 8 | byte(at + 2) << 16 | byte(at + 3) << 24;
    hash = std::rotl(hash ^ mixed(block), 13) * 5 + 0xe6546b64u;
  }
  std::uint32_t rest = 0;
  for (std::size_t k = text.size(); k > at; --k) rest = rest << 8 | byte(k - 1);
  if (text.size() > at) hash ^= mixed(rest);
  hash ^= static_cast<std::uint32_t>(text.size());
  hash = (hash ^ hash >> 16) * 0x85ebca6bu;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
  return hash ^ hash >> 16;
}

// An exponent of all zeros or all ones would be a denormal, an infinity or a NaN.
std::uint32_t usable_bits(std::uint32_t hash) {
  const std::uint32_t exponent = hash >> 23 & 0xff;
  return exponent == 0 || exponent == 0xff ? hash ^ 1u << 23 : hash;
}

std::vector<std::string> channel_names(std::size_t objects) {
  const std::size_t ranks = std::clamp<std::size_t>((objects + 1) / 2 * 2, 2, kMostRanks);
  std::vector<std::string> names;
  for (std::size_t rank = 0; rank < ranks; rank += 2)
    for (const char channel : {'R', 'G', 'B', 'A'})
      names.push_back(fmt::format("{}{:02}.{}", kLayer, rank / 2, channel));
  return names;
}

}  // namespace

float cryptomatte_id(const std::string& name) {
  return std::bit_cast<float>(usable_bits(murmur_hash(name)));
}

Cryptomatte::Cryptomatte(int width, int height, const std::vector<std::string>& objects)
    : image_(width, height, channel_names(objects.size())), objects_(objects) {}

// A pixel holds pairs of an identity and its part, the largest first.
void Cryptomatte::add(const std::string& name, const std::vector<float>& covered) {
  const float id = cryptomatte_id(name);
  const std::size_t count = image_.channels.size();
  for (std::size_t k = 0; k < covered.size(); ++k) {
    if (!(covered[k] > 0)) continue;
    float* const pixel = image_.pixels.data() + k * count;
    float new_id = id, part = covered[k];
    for (std::size_t rank = 0; rank < count; rank += 2)
      if (part > pixel[rank + 1]) {
        std::swap(new_id, pixel[rank]);
        std::swap(part, pixel[rank + 1]);
      }
  }
}

void Cryptomatte::add_in_front(const std::string& name, const std::vector<float>& covered) {
  const std::size_t count = image_.channels.size();
  for (std::size_t k = 0; k < covered.size(); ++k)
    for (std::size_t rank = 0; rank < count && covered[k] > 0; rank += 2)
      image_.pixels[k * count + rank + 1] *= 1 - covered[k];
  add(name, covered);
}

std::vector<std::pair<std::string, std::string>> Cryptomatte::attributes() const {
  nlohmann::json manifest = nlohmann::json::object();
  for (const std::string& name : objects_)
    manifest[name] = fmt::format("{:08x}", usable_bits(murmur_hash(name)));
  const std::string key =
      "cryptomatte/" + fmt::format("{:08x}", murmur_hash(kLayer)).substr(0, 7) + "/";
  return {
      {key + "name", kLayer},
      {key + "hash", "MurmurHash3_32"},
      {key + "conversion", "uint32_to_float32"},
      {key + "manifest", manifest.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)}};
}

}  // namespace domefall
