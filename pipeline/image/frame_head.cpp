#include "pipeline/image/frame_head.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string_view>

#include "pipeline/image/encode/picture_writers.h"

namespace domefall {
namespace {

constexpr std::string_view kExrStart = "\x76\x2f\x31\x01", kPngStart = "\x89PNG\r\n\x1a\n",
                           kTiffLittle{"II*\0", 4}, kTiffBig{"MM\0*", 4},
                           kJpegStart = "\xff\xd8\xff";

void check_digest(const FrameHead& head) {
  if (head.ours && head.digest.empty()) throw DamagedFile("its digest is gone");
}

// ---- the description of a PNG, TIFF or JPEG: lines of "name: value" ----

std::size_t place_of_value(std::string_view text, std::string_view line) {
  for (std::size_t begin = 0; begin < text.size();) {
    if (text.substr(begin).starts_with(line)) return begin + line.size();
    const auto end = text.find('\n', begin);
    if (end == std::string_view::npos) break;
    begin = end + 1;
  }
  return std::string_view::npos;
}

void take_description(std::string_view text, std::uint64_t at, FrameHead& head) {
  const auto take = [&](std::string_view line, std::string& value) {
    const auto begin = place_of_value(text, line);
    if (begin == std::string_view::npos) return begin;
    value = text.substr(begin, text.find('\n', begin) - begin);
    return begin;
  };
  take(kTitleLine, head.title);
  take(kProjectionLine, head.projection);
  take(kFrameLine, head.frame);
  const bool key = take(kKeyLine, head.key) != std::string_view::npos;
  const auto digest = take(kDigestLine, head.digest);
  if (digest != std::string_view::npos) head.digest_at = at + digest;
  head.ours =
      key || !head.digest.empty() || place_of_value(text, kSoftwareLine) != std::string_view::npos;
  check_digest(head);
}

// ---- OpenEXR: "OpenEXR File Layout", Header ----

struct Attribute {
  std::string type;
  std::uint64_t at, size;
};

// Returns a text that a zero ends, and moves `at` behind the zero.
std::string take_name(const FileBytes& file, std::uint64_t& at) {
  constexpr std::uint64_t kLongest = 256;  // with the zero
  const std::string bytes = file.at(at, std::min(kLongest, file.size() - at));
  const auto end = bytes.find('\0');
  if (end == std::string::npos) throw DamagedFile("a name in its header does not end");
  at += end + 1;
  return bytes.substr(0, end);
}

std::map<std::string, Attribute> read_attributes(const FileBytes& file, std::uint64_t& at) {
  constexpr std::size_t kMostAttributes = 1000;
  std::map<std::string, Attribute> attributes;
  for (;;) {
    const std::string name = take_name(file, at);
    if (name.empty()) return attributes;
    std::string type = take_name(file, at);
    const auto size = little_endian<std::uint32_t>(file.at(at, sizeof(std::uint32_t)));
    at += sizeof size;
    if (size > file.size() - at) throw DamagedFile("an attribute goes beyond its end");
    attributes[name] = {std::move(type), at, size};
    at += size;
    if (attributes.size() > kMostAttributes) throw DamagedFile("its header does not end");
  }
}

// Every part of the image has its place within the file.  A header that promises more than there is
// has a table that leads out of it.
void check_exr_table(const FileBytes& file, std::uint64_t table, std::int64_t height,
                     std::int64_t rows_per_part) {
  constexpr std::uint64_t kPlace = sizeof(std::uint64_t), kPiece = 8192;
  const auto parts = static_cast<std::uint64_t>((height + rows_per_part - 1) / rows_per_part);
  for (std::uint64_t first = 0; first < parts; first += kPiece) {
    const std::uint64_t count = std::min(kPiece, parts - first);
    const std::string places = file.at(table + kPlace * first, kPlace * count);
    for (std::uint64_t k = 0; k < count; ++k) {
      const auto place = little_endian<std::uint64_t>(std::string_view(places).substr(kPlace * k));
      if (place < table + kPlace * parts || place >= file.size())
        throw DamagedFile("a part of its image is missing");
    }
  }
}

// Returns the rows in one part, by the number of the compression, or nothing for a number that is
// not known here.
std::optional<std::int64_t> rows_per_part(unsigned char compression) {
  constexpr std::int64_t kRows[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
  if (compression >= std::size(kRows)) return std::nullopt;
  return kRows[compression];
}

FrameHead read_exr_head(const FileBytes& file) {
  constexpr std::uint32_t kScanLines = 2;  // the version, and no flag of tiles or of several parts
  const auto version = little_endian<std::uint32_t>(file.at(kExrStart.size(), 4));
  std::uint64_t at = kExrStart.size() + sizeof version;
  const auto attributes = read_attributes(file, at);
  const auto value = [&](const char* name, std::uint64_t size) {
    const auto found = attributes.find(name);
    if (found == attributes.end() || found->second.size != size)
      throw DamagedFile(std::string("its header has no ") + name);
    return file.at(found->second.at, size);
  };
  FrameHead head;
  head.format = FrameFormat::kExr;
  const std::string window = value("dataWindow", 16);
  const auto edge = [&window](std::size_t k) -> std::int64_t {
    return static_cast<std::int32_t>(
        little_endian<std::uint32_t>(std::string_view(window).substr(4 * k)));
  };
  head.width = edge(2) - edge(0) + 1;
  head.height = edge(3) - edge(1) + 1;
  if (head.width < 1 || head.height < 1) throw DamagedFile("its size makes no sense");
  const auto text = [&](const char* name, std::string& into) {
    const auto found = attributes.find(name);
    if (found == attributes.end() || found->second.type != "string") return false;
    into = file.at(found->second.at, found->second.size);
    return true;
  };
  text(kExrTitle, head.title);
  text(kExrProjection, head.projection);
  const bool key = text(kExrKey, head.key), digest = text(kExrDigest, head.digest);
  if (digest) head.digest_at = attributes.at(kExrDigest).at;
  head.ours = key || digest || attributes.contains(kExrTitle);
  check_digest(head);
  const auto rows = rows_per_part(static_cast<unsigned char>(value("compression", 1)[0]));
  if (version == kScanLines && rows) check_exr_table(file, at, head.height, *rows);
  return head;
}

// ---- PNG: the specification, 5.3: length of the data, name, data, CRC-32 of name and data ----

void read_size(std::string_view data, FrameHead& head) {
  head.width = big_endian<std::uint32_t>(data);
  head.height = big_endian<std::uint32_t>(data.substr(4));
  head.bits = static_cast<unsigned char>(data[8]);
}

// All chunks before the pixels are held against their checksums.
FrameHead read_png_head(const FileBytes& file) {
  constexpr std::uint64_t kNumber = 4, kHeader = 13;
  const std::string keyword = "tEXt" + std::string(kPngKeyword);
  FrameHead head;
  head.format = FrameFormat::kPng;
  for (std::uint64_t chunk = kPngStart.size();;) {
    const std::uint64_t name = chunk + kNumber;
    const auto length = big_endian<std::uint32_t>(file.at(chunk, kNumber));
    const std::string kind = file.at(name, kNumber);
    const bool first = chunk == kPngStart.size();
    if (first != (kind == "IHDR") || (first && length != kHeader))
      throw DamagedFile("its first chunk is not that of a PNG");
    if (kind == "IDAT" || kind == "IEND") return head;
    const std::string data = file.at(name, kNumber + std::uint64_t{length});
    const std::uint64_t end = name + data.size();
    if (png_checksum(data) != file.at(end, kNumber))
      throw DamagedFile("the checksum of a chunk is off");
    if (first) read_size(std::string_view(data).substr(kNumber), head);
    if (data.starts_with(keyword)) {
      take_description(std::string_view(data).substr(keyword.size()), name + keyword.size(), head);
      head.chunk_at = name, head.checksum_at = end;
    }
    chunk = end + kNumber;
  }
}

// ---- TIFF 6.0, section 2 ----

bool holds_text(const FileBytes& file, std::string_view text) {
  constexpr std::uint64_t kBlock = std::uint64_t{1} << 20;
  for (std::uint64_t at = 0; at < file.size(); at += kBlock) {
    const std::uint64_t count = std::min(kBlock + text.size(), file.size() - at);
    if (file.at(at, count).find(text) != std::string::npos) return true;
  }
  return false;
}

class TiffDirectory {
 public:
  TiffDirectory(const FileBytes& file, bool big) : file_(file), big_(big) {
    constexpr std::uint64_t kEntry = 12, kPlace = 4, kCount = 2;
    const std::uint64_t at = number<std::uint32_t>(file_.at(kPlace, 4));
    const auto count = number<std::uint16_t>(file_.at(at, kCount));
    for (std::uint64_t k = 0; k < count; ++k) {
      const std::string entry = file_.at(at + kCount + k * kEntry, kEntry);
      const auto field = [&entry](std::size_t from) {
        return std::string_view(entry).substr(from);
      };
      // The first of a kind counts, so that a wrong number of entries does no harm.
      entries_.try_emplace(number<std::uint16_t>(field(0)),
                           Entry{number<std::uint16_t>(field(2)), number<std::uint32_t>(field(4)),
                                 at + kCount + k * kEntry + 8});
    }
  }

  std::int64_t size(std::uint16_t tag) const {
    constexpr std::uint16_t kShort = 3;
    const auto found = entries_.find(tag);
    if (found == entries_.end()) throw DamagedFile("its header has no size");
    const std::string value = file_.at(found->second.at, 4);
    return found->second.type == kShort ? number<std::uint16_t>(value)
                                        : number<std::uint32_t>(value);
  }

  // Returns the first of several short numbers, which stand in the entry where there are at most
  // two.  Returns 0 if there is none.
  int first_short(std::uint16_t tag) const {
    constexpr std::uint16_t kShort = 3, kMostInEntry = 2;
    const auto found = entries_.find(tag);
    if (found == entries_.end() || found->second.type != kShort) return 0;
    const std::uint64_t at = found->second.at;
    return number<std::uint16_t>(file_.at(
        found->second.count > kMostInEntry ? number<std::uint32_t>(file_.at(at, 4)) : at, 2));
  }

  // Returns where the text stands and its length, or nothing if there is none.  A text of up to
  // four bytes stands in the entry itself, and ours are longer.
  std::optional<std::pair<std::uint64_t, std::uint64_t>> text(std::uint16_t tag) const {
    constexpr std::uint16_t kAscii = 2;
    const auto found = entries_.find(tag);
    if (found == entries_.end() || found->second.type != kAscii || found->second.count <= 4)
      return std::nullopt;
    return std::pair<std::uint64_t, std::uint64_t>(
        number<std::uint32_t>(file_.at(found->second.at, 4)), found->second.count);
  }

 private:
  struct Entry {
    std::uint16_t type;
    std::uint32_t count;
    std::uint64_t at;  // of the value, or of its place
  };
  template <class Number>
  Number number(std::string_view bytes) const {
    return big_ ? big_endian<Number>(bytes) : little_endian<Number>(bytes);
  }

  const FileBytes& file_;
  bool big_;
  std::map<std::uint16_t, Entry> entries_;
};

// Says whether the file holds a description of ours, which a damaged directory no longer leads to.
bool holds_our_lines(const FileBytes& file) { return holds_text(file, kSoftwareLine); }

FrameHead read_tiff_head(const FileBytes& file, bool big) {
  constexpr std::uint16_t kWidth = 256, kHeight = 257, kBits = 258, kDescription = 270;
  FrameHead head;
  head.format = FrameFormat::kTiff;
  const TiffDirectory directory(file, big);
  head.width = directory.size(kWidth);
  head.height = directory.size(kHeight);
  head.bits = directory.first_short(kBits);
  if (const auto text = directory.text(kDescription))
    take_description(file.at(text->first, text->second), text->first, head);
  if (!head.ours && holds_our_lines(file)) throw DamagedFile("its directory is broken");
  return head;
}

// ---- JPEG: ISO/IEC 10918-1, annex B ----

// Reads all segments before the pixels.  A segment is 0xff and a code, a length that includes
// itself, and data.  Nothing but the file's digest reveals damage to them.
FrameHead read_jpeg_head(const FileBytes& file) {
  constexpr unsigned char kFirstFrame = 0xc0, kLastFrame = 0xcf, kHuffman = 0xc4,
                          kArithmetic = 0xcc, kExtension = 0xc8, kScan = 0xda, kComment = 0xfe;
  FrameHead head;
  head.format = FrameFormat::kJpeg;
  for (std::uint64_t at = 2;;) {
    const std::string start = file.at(at, 4);
    const auto code = static_cast<unsigned char>(start[1]);
    const auto length = big_endian<std::uint16_t>(std::string_view(start).substr(2));
    if (start[0] != '\xff' || length < 2) throw DamagedFile("its header does not fit together");
    if (code == kScan) break;
    const std::string data = file.at(at + 4, length - std::uint64_t{2});
    if (code >= kFirstFrame && code <= kLastFrame && code != kHuffman && code != kArithmetic &&
        code != kExtension) {
      constexpr std::size_t kSizes = 5;
      if (data.size() < kSizes) throw DamagedFile("its header has no size");
      head.bits = static_cast<unsigned char>(data[0]);
      head.height = big_endian<std::uint16_t>(std::string_view(data).substr(1));
      head.width = big_endian<std::uint16_t>(std::string_view(data).substr(3));
    }
    if (code == kComment) take_description(data, at + 4, head);
    at += 2 + std::uint64_t{length};
  }
  if (!head.ours && holds_our_lines(file)) throw DamagedFile("its header is broken");
  return head;
}

}  // namespace

std::string one_line(std::string title) {
  std::replace_if(
      title.begin(), title.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return title;
}

bool may_be_rest_of_frame(const FileBytes& file, FrameFormat wanted) {
  constexpr std::uint64_t kBlock = 512;
  const std::string start = file.at(0, std::min(file.size(), kBlock));
  if (start.find_first_not_of('\0') == std::string::npos) return true;
  for (const std::string_view magic : {kExrStart, kPngStart, kTiffLittle, kTiffBig, kJpegStart})
    if ((start.starts_with(magic) || magic.starts_with(start)) &&
        (magic != kJpegStart || wanted == FrameFormat::kJpeg))
      return true;
  return holds_text(file, kExrKey) || holds_text(file, kSoftwareLine);
}

std::optional<FrameHead> read_frame_head(const FileBytes& file) {
  const std::string start = file.at(0, std::min<std::uint64_t>(file.size(), kPngStart.size()));
  if (start.starts_with(kExrStart)) return read_exr_head(file);
  if (start == kPngStart) return read_png_head(file);
  if (start.starts_with(kTiffLittle)) return read_tiff_head(file, false);
  if (start.starts_with(kTiffBig)) return read_tiff_head(file, true);
  if (start.starts_with(kJpegStart)) return read_jpeg_head(file);
  return std::nullopt;
}

}  // namespace domefall
