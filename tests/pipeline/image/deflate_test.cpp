#include "pipeline/base/deflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <iostream>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/digest.h"

namespace domefall {
namespace {

// Bytes like those of a picture: slow changes with some noise.
std::string sample(std::size_t count) {
  std::mt19937 random(11);
  std::string bytes(count, '\0');
  unsigned value = 0;
  for (char& byte : bytes) {
    const auto chance = static_cast<unsigned>(random());
    value += chance % 64 < 8 ? chance >> 8 & 7 : 0;
    byte = static_cast<char>(value);
  }
  return bytes;
}

std::string noise(std::size_t count) {
  std::mt19937 random(5);
  std::string bytes(count, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random());
  return bytes;
}

std::string unpacked(std::string_view stream, std::size_t size) {
  std::string bytes(size, '\0');
  auto length = static_cast<uLongf>(size);
  const int result =
      uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                 reinterpret_cast<const Bytef*>(stream.data()), static_cast<uLong>(stream.size()));
  EXPECT_EQ(result, Z_OK);
  EXPECT_EQ(length, size);
  return bytes;
}

std::string big_endian_text(unsigned number) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(number >> shift & 0xff);
  return text;
}

TEST(Deflate, IsUnpackedByZlib) {
  Deflater deflater;
  ByteBlock out;
  for (const std::string& bytes : {std::string(), std::string("x"), sample(1 << 20),
                                   std::string(100'000, 'a'), noise(200'000)}) {
    deflater.pack_stream(bytes, out);
    EXPECT_EQ(unpacked(out.view(), bytes.size()), bytes) << bytes.size();
  }
}

// What cannot be packed grows by a few bytes, and does not overrun the memory.
TEST(Deflate, StoresNoiseAsItIs) {
  Deflater deflater;
  ByteBlock out;
  for (const std::size_t size : {1U, 100U, 65'535U, 65'536U, 1'000'000U}) {
    deflater.pack_stream(noise(size), out);
    EXPECT_LT(out.size(), size + size / 1000 + 32) << size;
  }
}

// Whether what stands at the third byte is found again depends on the address of ISA-L's state
// (stream_memory() in deflate.cpp).  Four zeros have slot 0, to which each deflater's address must lead.
TEST(Deflate, FindsTheThirdByteAgainFromEveryDeflater) {
  constexpr std::size_t kFound = 2622;  // bytes; one more where the zeros are not found again
  std::mt19937 random(3);
  std::string bytes("\1\2");
  for (int k = 0; k < 40; ++k) {
    if (k < 2) bytes += std::string(4, '\0');
    // Short repetitions at the same distance, whose codes the header then has anyway.
    const std::size_t start = bytes.size();
    if (k > 1) bytes += bytes.substr(start - 69, 4);
    while (bytes.size() < start + (k < 2 ? 65 : 69))
      bytes += static_cast<char>(64 + random() % 192);
  }
  bytes += std::string(3000, 'z');
  std::vector<Deflater> deflaters(40);
  for (Deflater& deflater : deflaters) {
    ByteBlock out;
    deflater.pack_part(bytes, out);
    EXPECT_EQ(out.size(), kFound);
  }
}

TEST(Deflate, PartsMakeOneStream) {
  const std::string bytes = sample(300'000);
  Deflater deflater;
  ByteBlock out;
  std::string stream(kStreamStart);
  unsigned sum = 1;
  for (std::size_t at = 0, count = 1; at < bytes.size(); at += count, count = 7 * count + 3) {
    const std::string_view part = std::string_view(bytes).substr(at, count);
    deflater.pack_part(part, out);
    stream += out.view();
    sum = adler32_joined(sum, adler32_of(part), part.size());
  }
  EXPECT_EQ(sum, adler32_of(bytes));
  stream += kStreamEnd;
  stream += big_endian_text(sum);
  EXPECT_TRUE(unpacked(stream, bytes.size()) == bytes);
}

TEST(Deflate, SumsAreThoseOfZlib) {
  const std::string bytes = noise(123'457);
  const auto theirs = [](unsigned long before, std::string_view text) {
    return static_cast<unsigned>(adler32(before, reinterpret_cast<const Bytef*>(text.data()),
                                         static_cast<uInt>(text.size())));
  };
  EXPECT_EQ(adler32_of(bytes), theirs(1, bytes));
  for (const std::size_t cut :
       {std::size_t{0}, std::size_t{1}, std::size_t{70'000}, bytes.size()}) {
    const std::string_view first = std::string_view(bytes).substr(0, cut),
                           second = std::string_view(bytes).substr(cut);
    EXPECT_EQ(adler32_joined(adler32_of(first), adler32_of(second), second.size()),
              theirs(1, bytes));
    EXPECT_EQ(adler32_of(second, adler32_of(first)), theirs(1, bytes));
  }
}

// The memory of one picture is that of the next, and each thread has its own.
TEST(Deflate, GivesTheSameBytesWhateverWasPackedBefore) {
  const std::string bytes = sample(400'000);
  Deflater fresh, used;
  ByteBlock first, second;
  fresh.pack_stream(bytes, first);
  for (const std::string& before : {noise(500'000), sample(3), std::string(90'000, 'z')})
    used.pack_part(before, second);
  // The packer need not begin at an address like that of the first.
  const std::string shifted = "123" + bytes;
  used.pack_stream(std::string_view(shifted).substr(3), second);
  EXPECT_TRUE(first.view() == second.view());
}

// Leaves small numbers of 16 bits all over the stack.
[[gnu::noinline]] void scribble(unsigned char even, unsigned char odd) {
  std::array<volatile unsigned char, 300'000> stack;
  for (std::size_t k = 0; k < stack.size(); ++k) stack[k] = k % 2 ? odd : even;
}

// ISA-L does not set all that it reads.
TEST(Deflate, GivesTheSameBytesWhateverWasOnTheStack) {
  const std::string bytes = sample(400'000);
  Deflater deflater;
  ByteBlock first, second;
  deflater.pack_stream(bytes, first);
  for (const auto& [even, odd] : {std::pair(0, 0), std::pair(9, 0), std::pair(0, 9)}) {
    scribble(static_cast<unsigned char>(even), static_cast<unsigned char>(odd));
    deflater.pack_stream(bytes, second);
    EXPECT_TRUE(first.view() == second.view()) << even;
  }
}

// cli/packed_bytes.sh compares what this prints with what it prints on other processors.  Another
// version of ISA-L packs otherwise.
TEST(Deflate, PacksIntoTheSameBytesAgain) {
  const auto digest_of_samples = [] {
    Deflater deflater;
    ByteBlock out;
    Digest digest;
    for (const std::size_t size : {std::size_t{1000}, std::size_t{100'000}, std::size_t{1} << 20}) {
      deflater.pack_stream(sample(size), out);
      digest.add(out.view());
      deflater.pack_part(sample(size), out);
      digest.add(out.view());
    }
    return digest.hex();
  };
  const std::string packed = digest_of_samples();
  EXPECT_EQ(digest_of_samples(), packed);
  std::cout << "packed bytes: " << packed << "\n";
}

}  // namespace
}  // namespace domefall
