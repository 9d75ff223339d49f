#include "pipeline/farm/file_finding.h"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>

#include "pipeline/farm/brightest_value.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/file_bytes.h"

namespace domefall {
namespace {

constexpr std::int64_t kNanosecondsOfSecond = 1'000'000'000;

FileFinding found_as(FrameCondition condition) {
  FileFinding finding;
  finding.condition = condition;
  return finding;
}

// Calls look() and takes what stops it for a file that cannot be read.
template <class Look>
FileFinding unless_unreadable(const Look& look) {
  const auto unreadable = [](const char* why) {
    FileFinding finding;
    finding.unreadable = why;
    return finding;
  };
  try {
    return look();
  } catch (const InputError& error) {
    return unreadable(error.what());
  } catch (const TemporaryError& error) {
    return unreadable(error.what());
  }
}

bool is_black(const std::filesystem::path& path, double brightest) {
  return brightest <= (path.extension() == ".exr" ? kBrightestOfBlack : kBrightestOfBlackCodes);
}

// Says whether manifests have lines for the file with the wanted key, but `same` holds for none of
// them.
template <class Same>
bool is_unlike_all(const Manifest& manifest, const ExpectedFile& file, const Same& same) {
  const auto lines = manifest.files.find(file.name);
  if (lines == manifest.files.end()) return false;
  const auto is_wanted = [&](const MadeFile& made) { return made.key == file.wanted.key; };
  return std::ranges::any_of(lines->second, is_wanted) &&
         std::ranges::none_of(lines->second,
                              [&](const MadeFile& made) { return is_wanted(made) && same(made); });
}

void look_at_light(const ExpectedFile& file, const Manifest& manifest, const std::string& digest,
                   FileFinding& finding) {
  const MadeFile* made = manifest.find(file.name, digest);
  try {
    const double brightest = made ? made->brightest : brightest_in_file(file.path);
    finding.black = is_black(file.path, brightest);
    finding.not_finite = !std::isfinite(brightest);
  } catch (const InputError&) {
    throw;
  } catch (const TemporaryError&) {
    throw;
  } catch (const std::runtime_error&) {  // a decoder does not take it, whatever its digest
    finding.condition = FrameCondition::kDamaged;
  }
}

}  // namespace

FileFinding glance_at(const ExpectedFile& file, const Manifest& manifest) {
  return unless_unreadable([&]() -> FileFinding {
    struct stat status {};
    if (stat(file.path.c_str(), &status) == 0 && S_ISREG(status.st_mode)) {
      const auto size = static_cast<std::uint64_t>(status.st_size);
      const MadeFile* made = manifest.find(
          file.name, size, status.st_mtim.tv_sec * kNanosecondsOfSecond + status.st_mtim.tv_nsec);
      if (made && made->key == file.wanted.key) return found_as(FrameCondition::kGood);
    }
    FileFinding finding = found_as(claimed_condition(file.path, file.wanted));
    if (finding.condition != FrameCondition::kGood) return finding;
    // The same key gives the same bytes, so a file of another size is damaged.
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (is_unlike_all(manifest, file, [&](const MadeFile& made) { return made.size == size; }))
      finding.condition = FrameCondition::kDamaged;
    return finding;
  });
}

FileFinding examine_file(const ExpectedFile& file, const Manifest& manifest) {
  return unless_unreadable([&]() -> FileFinding {
    const auto bytes = FileBytes::open(file.path);
    if (!bytes) return {};
    try {
      FileFinding finding = found_as(examine_frame(*bytes, file.path, file.wanted));
      if (finding.condition != FrameCondition::kGood) return finding;
      const std::string digest = read_frame_head(*bytes)->digest;
      finding.unlike = is_unlike_all(manifest, file,
                                     [&](const MadeFile& made) { return made.digest == digest; });
      look_at_light(file, manifest, digest, finding);
      return finding;
    } catch (const DamagedFile&) {  // shortened meanwhile
      return found_as(FrameCondition::kDamaged);
    }
  });
}

}  // namespace domefall
