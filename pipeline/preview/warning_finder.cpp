#include "pipeline/preview/warning_finder.h"

#include <sys/resource.h>
#include <unistd.h>

#include "pipeline/preview/show_facts.h"

namespace domefall {
namespace {

// A version of the show must stay as it is for this long, so that not every save of a series is
// examined.
constexpr int kCalmSeconds = 2;

}  // namespace

WarningFinder::WarningFinder(LiveShow& show) : show_(show), finding_([this] { find(); }) {}

WarningFinder::~WarningFinder() {
  stop_ = true;
  show_.stop();
  finding_.join();
}

std::string WarningFinder::as_json() const {
  const std::lock_guard lock(mutex_);
  if (revision_ != show_.version().revision) return no_warnings_as_json(false);
  return found_;
}

void WarningFinder::find() {
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 19);  // pictures come first
  LiveShow::Version version = show_.version();
  while (!stop_) {
    const LiveShow::Version later = show_.changed_since(version.readings, kCalmSeconds);
    const bool calm = later.readings == version.readings;
    version = later;
    bool known = false;
    {
      const std::lock_guard lock(mutex_);
      known = revision_ == version.revision;
    }
    if (!calm || known || stop_) continue;
    std::string found;
    try {
      found = show_warnings_as_json(*version.show, stop_);
    } catch (const std::exception&) {
      // What cannot be read now is told where a picture needs it.
      found = no_warnings_as_json(true);
    }
    const std::lock_guard lock(mutex_);
    revision_ = version.revision;
    found_ = std::move(found);
  }
}

}  // namespace domefall
