#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <utility>

#include "pipeline/farm/manifest.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/file_bytes.h"
#include "pipeline/image/frame_head.h"
#include "pipeline/image/writer_id.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

std::string this_host() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

double seconds_since_1970() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

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

}  // namespace domefall
