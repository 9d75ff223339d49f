#include "pipeline/render/frames/manifest.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "pipeline/base/errors.h"
#include "pipeline/base/in_parallel.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/talk.h"
#include "pipeline/base/writer_id.h"
#include "pipeline/image/frame_head.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string line_of(const Json& json) {
  // A file's name need not be UTF-8.  A name that is not is not found again, and its file is read.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

MadeFile made_of(const nlohmann::json& json) {
  return {.frame = json.at("frame").get<int>(),
          .file = json.at("file").get<std::string>(),
          .size = json.at("size").get<std::uint64_t>(),
          .mtime_ns = json.at("mtime_ns").get<std::int64_t>(),
          .digest = json.at("digest").get<std::string>(),
          .key = json.at("key").get<std::string>(),
          .seconds = json.at("seconds").get<double>(),
          .brightest = json.at("brightest").get<double>(),
          .host = json.at("host").get<std::string>(),
          .pid = json.at("pid").get<pid_t>()};
}

std::string this_host() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

double seconds_since_1970() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

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
  say("warning: " + why + "; this manifest is left out");
  return std::nullopt;
}

}  // namespace

std::string text_of(const MadeFile& made) {
  return line_of({{"frame", made.frame},
                  {"file", made.file},
                  {"size", made.size},
                  {"digest", made.digest},
                  {"mtime_ns", made.mtime_ns},
                  {"key", made.key},
                  {"seconds", made.seconds},
                  {"brightest", made.brightest},
                  {"host", made.host},
                  {"pid", made.pid}});
}

std::string text_of(const BegunFrame& begun) {
  return line_of({{"frame", begun.frame},
                  {"begun_s", begun.since_s},
                  {"host", begun.host},
                  {"pid", begun.pid}});
}

std::optional<ManifestLine> parse_manifest_line(std::string_view line) {
  const auto json = nlohmann::json::parse(line, nullptr, false);
  try {
    ManifestLine parsed;
    if (json.contains("begun_s"))
      parsed.begun = BegunFrame{json.at("frame").get<int>(), json.at("begun_s").get<double>(),
                                json.at("host").get<std::string>(), json.at("pid").get<pid_t>()};
    else
      parsed.made = made_of(json);
    return parsed;
  } catch (const nlohmann::json::exception&) {  // torn, or of another kind
    return std::nullopt;
  }
}

fs::path manifest_folder(const fs::path& frames) { return frames / "farm" / "manifest"; }

ManifestWriter::ManifestWriter(fs::path frames) : frames_(std::move(frames)), host_(this_host()) {
  std::error_code ignored;
  on_ = fs::is_directory(manifest_folder(frames_).parent_path(), ignored);
}

ManifestWriter::~ManifestWriter() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool ManifestWriter::open_file() {
  if (descriptor_ >= 0) return true;
  const fs::path folder = manifest_folder(frames_);
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  WriterId writer = this_writer();
  writer.device = device_of(folder);
  const fs::path path = folder / (text_of(writer) + ".jsonl");
  constexpr unsigned kMode = 0666;
  descriptor_ = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, kMode);
  // Where there are no locks the number of the process tells whether it lives.
  if (descriptor_ >= 0) (void)flock(descriptor_, LOCK_EX | LOCK_NB);
  return descriptor_ >= 0;
}

void ManifestWriter::append(const std::string& line) {
  const std::lock_guard held(mutex_);
  if (!on_ || !open_file()) return;
  // One call writes it, so that a line is torn only where the machine stops or the disk is full.
  // Then what follows begins a line of its own.
  const ssize_t written = write(descriptor_, line.data(), line.size());
  if (written > 0 && static_cast<std::size_t>(written) < line.size())
    on_ = write(descriptor_, "\n", 1) == 1;
}

void ManifestWriter::begin(int frame) {
  if (on_) append(text_of(BegunFrame{frame, seconds_since_1970(), host_, getpid()}));
}

void ManifestWriter::made(int frame, const fs::path& path, double seconds, double brightest) {
  if (!on_) return;
  try {
    const auto file = FileBytes::open(path);
    const auto head = file ? read_frame_head(*file) : std::nullopt;
    struct stat status {};
    if (!head || stat(path.c_str(), &status) != 0) return;  // somebody has taken it away
    constexpr std::int64_t kNanoseconds = 1'000'000'000;
    append(text_of(MadeFile{frame, path.lexically_relative(frames_).string(),
                            static_cast<std::uint64_t>(status.st_size),
                            status.st_mtim.tv_sec * kNanoseconds + status.st_mtim.tv_nsec,
                            head->digest, head->key, std::round(seconds * 1000) / 1000, brightest,
                            host_, getpid()}));
  } catch (const DamagedFile&) {  // somebody has put another one there
  } catch (const InputError&) {
  } catch (const TemporaryError&) {  // the file server is gone, which the next frame will say
  }
}

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
