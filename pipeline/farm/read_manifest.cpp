#include <sys/stat.h>

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <optional>
#include <utility>

#include "pipeline/deliver/in_parallel.h"
#include "pipeline/farm/manifest.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/regular_file.h"
#include "pipeline/image/writer_id.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

// A process writes some 500 bytes a frame, and a show has at most ten million frames.
constexpr std::uint64_t kMostManifest = std::uint64_t{8} << 30;

struct ReadManifest {
  FrameWriter writer;
  std::vector<MadeFile> made;
};

std::vector<fs::path> manifests_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;  // a folder that is not there has none
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == ".jsonl" && writer_of(entry->path().stem().string()))
      found.push_back(entry->path());
  std::sort(found.begin(), found.end());
  return found;
}

void take_line(std::string_view text, ReadManifest& read, std::map<int, std::int64_t>& finished) {
  const auto line = parse_manifest_line(text);
  if (!line) return;
  const auto& begun = line->begun;
  if (begun) {
    if (read.writer.first_s == 0) read.writer.first_s = begun->since_s;
    read.writer.being_made[begun->frame] = begun->since_s;
    read.writer.host = begun->host;
    read.writer.pid = begun->pid;
  } else {
    const MadeFile& made = *line->made;
    read.writer.being_made.erase(made.frame);
    std::int64_t& ready = finished[made.frame];
    ready = std::max(ready, made.mtime_ns);
    read.made.push_back(made);
  }
}

ReadManifest read_one(const fs::path& path) {
  ReadManifest read;
  const RegularFile file(path);
  struct stat status {};
  const bool known = fstat(file.descriptor(), &status) == 0;
  read.writer.last_sign_s = known ? static_cast<double>(status.st_mtime) : 0;
  const auto id = writer_of(path.stem().string());
  read.writer.ended = id && known && has_ended(*id, file.descriptor(), status.st_dev);
  const std::string text = read_file(path, kMostManifest);
  std::map<int, std::int64_t> finished;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    take_line(std::string_view(text).substr(begin, end - begin), read, finished);
    begin = end + 1;
  }
  for (const auto& [frame, ready] : finished) read.writer.finished.push_back(ready);
  if (read.writer.ended) read.writer.being_made.clear();
  return read;
}

std::optional<ReadManifest> read_if_possible(const fs::path& path) {
  std::string why;
  try {
    return read_one(path);
  } catch (const InputError& error) {
    why = error.what();
  } catch (const TemporaryError& error) {
    why = error.what();
  }
  std::fprintf(stderr, "warning: %s; this manifest is left out\n", why.c_str());
  return std::nullopt;
}

}  // namespace

const MadeFile* Manifest::find(const std::string& file, std::uint64_t size,
                               std::int64_t mtime_ns) const {
  const auto lines = files.find(file);
  if (lines == files.end()) return nullptr;
  const auto same = std::ranges::find_if(lines->second, [&](const MadeFile& made) {
    return made.size == size && made.mtime_ns == mtime_ns;
  });
  return same == lines->second.end() ? nullptr : &*same;
}

const MadeFile* Manifest::find(const std::string& file, const std::string& digest) const {
  const auto lines = files.find(file);
  if (lines == files.end()) return nullptr;
  const auto same = std::ranges::find(lines->second, digest, &MadeFile::digest);
  return same == lines->second.end() ? nullptr : &*same;
}

Manifest read_manifest(const fs::path& frames, int threads) {
  const std::vector<fs::path> paths = manifests_in(manifest_folder(frames));
  std::vector<std::optional<ReadManifest>> read(paths.size());
  in_parallel(static_cast<int>(paths.size()), threads, [&](int k) {
    read[static_cast<std::size_t>(k)] = read_if_possible(paths[static_cast<std::size_t>(k)]);
  });
  Manifest manifest;
  for (std::optional<ReadManifest>& one : read) {
    if (!one) continue;
    for (MadeFile& made : one->made) manifest.files[made.file].push_back(std::move(made));
    manifest.writers.push_back(std::move(one->writer));
  }
  return manifest;
}

}  // namespace domefall
