#include "pipeline/preview/live_show.h"

#include <chrono>
#include <optional>

#include "pipeline/image/errors.h"
#include "pipeline/render/frame_bands.h"
#include "pipeline/show/read_show.h"

namespace domefall {
namespace {

// How often the watch looks whether it is to end.
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

LiveShow::LiveShow(const std::filesystem::path& file, int threads) : file_(file), written_(file) {
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
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  news_.notify_all();
}

void LiveShow::watch() {
  for (;;) {
    const bool written = written_.wait(kPatience);
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
  const NewestFirst::Turn turn = turns_.enter({"the program", 0, false});
  if (turn != NewestFirst::Turn::kNow)
    throw TemporaryError("too many pictures are asked for at once");
  const HeldTurn held(turns_);
  use(*pictures_);
}

}  // namespace domefall
