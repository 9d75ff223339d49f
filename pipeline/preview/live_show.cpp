#include "pipeline/preview/live_show.h"

#include <chrono>
#include <optional>

#include "pipeline/image/errors.h"
#include "pipeline/render/frame_bands.h"
#include "pipeline/show/read_show.h"

namespace domefall {
namespace {

// This is how long the watch waits before it looks whether it is to end.
constexpr int kPatience = 200;  // milliseconds

// Leaves the turn at the end of a scope.
class HeldTurn {
 public:
  explicit HeldTurn(NewestFirst& turns) : turns_(turns) {}
  HeldTurn(const HeldTurn&) = delete;
  HeldTurn(HeldTurn&&) = delete;
  HeldTurn& operator=(const HeldTurn&) = delete;
  HeldTurn& operator=(HeldTurn&&) = delete;
  ~HeldTurn() { turns_.leave(); }

 private:
  NewestFirst& turns_;
};

}  // namespace

LiveShow::LiveShow(const std::filesystem::path& file, int threads) : file_(file) {
  // A file that is not there cannot be watched, and read_show tells of it.
  if (std::filesystem::exists(file)) watch_.emplace(file);
  auto show = std::make_shared<const Show>(read_show(file));
  pictures_ = std::make_unique<LivePictures>(*show, threads);
  version_ = {1, 1, std::move(show), {}, pictures_->display(), pictures_->view()};
  threads_ = pictures_->threads();
  watching_ = std::thread([this] { watch(); });
}

LiveShow::~LiveShow() {
  stop();
  watching_.join();
}

void LiveShow::stop() {
  turns_.end();
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  news_.notify_all();
}

void LiveShow::watch() {
  for (;;) {
    bool written = true;
    try {
      if (watch_) written = watch_->wait(kPatience);
      // The file may stand in another folder by now, or be a link to another one.  Who watches
      // before reading misses nothing.
      if (written) watch_.emplace(file_);
    } catch (const TemporaryError& error) {
      watch_.reset();
      written = false;
      tell(error.what());
      std::this_thread::sleep_for(std::chrono::milliseconds(kPatience));
    }
    {
      const std::lock_guard lock(mutex_);
      if (stopped_) return;
    }
    if (written) reload();
  }
}

void LiveShow::reload() {
  std::string mistake;
  try {
    const auto show = std::make_shared<const Show>(read_show(file_));
    with_pictures([&](LivePictures& pictures) {
      pictures.take(*show);
      const std::lock_guard lock(mutex_);
      version_ = {version_.revision + 1, version_.readings, show, {},
                  pictures.display(),    pictures.view()};
    });
  } catch (const std::exception& error) {
    mistake = error.what();
  }
  const std::lock_guard lock(mutex_);
  version_.mistake = mistake;
  ++version_.readings;
  news_.notify_all();
}

void LiveShow::tell(const std::string& mistake) {
  const std::lock_guard lock(mutex_);
  if (version_.mistake == mistake) return;
  version_.mistake = mistake;
  ++version_.readings;
  news_.notify_all();
}

LiveShow::Version LiveShow::version() const {
  const std::lock_guard lock(mutex_);
  return version_;
}

LiveShow::Version LiveShow::changed_since(int readings, int seconds) const {
  std::unique_lock lock(mutex_);
  news_.wait_for(lock, std::chrono::seconds(seconds),
                 [&] { return stopped_ || version_.readings != readings; });
  return version_;
}

std::optional<LiveShow::Made> LiveShow::picture(const Parameters& parameters,
                                                const NewestFirst::Ticket& ticket) {
  const NewestFirst::Turn turn = turns_.enter(ticket);
  if (turn == NewestFirst::Turn::kTooMany)
    throw TemporaryError("too many pictures are asked for at once");
  if (turn == NewestFirst::Turn::kOutdated) return std::nullopt;
  const HeldTurn held(turns_);
  const int revision = version().revision;
  try {
    return Made{pictures_->make(read_request(parameters, pictures_->show()), turns_.stop()),
                revision};
  } catch (const RenderStopped&) {
    return std::nullopt;
  }
}

void LiveShow::with_pictures(const std::function<void(LivePictures&)>& use) {
  const NewestFirst::Turn turn = turns_.enter(NewestFirst::own_ticket());
  if (turn != NewestFirst::Turn::kNow) throw TemporaryError("the preview ends");
  const HeldTurn held(turns_);
  use(*pictures_);
}

}  // namespace domefall
