#include "pipeline/program/preview/live_show.h"

#include <fcntl.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <boost/asio/use_future.hpp>
#include <chrono>
#include <optional>
#include <utility>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/render/frame_bands.h"
#include "pipeline/show/file/read_show.h"

namespace domefall {
namespace {

// The file is looked at as often as this.
constexpr std::chrono::milliseconds kLook{100};

// Leaves the turn at the end of a scope.
class HeldTurn {
 public:
  explicit HeldTurn(NewestFirst& turns) : turns_(turns) {}
  HeldTurn(const HeldTurn&) = delete;
  HeldTurn& operator=(const HeldTurn&) = delete;
  ~HeldTurn() { turns_.leave(); }

 private:
  NewestFirst& turns_;
};

// Returns what a function returns on another thread, or throws what it throws there.
template <class Function>
auto result_on(boost::asio::thread_pool& thread, const Function& function) {
  return boost::asio::post(thread, boost::asio::use_future(function)).get();
}

// NFS asks its server for a file's time and size when the file is opened, and otherwise only every
// few seconds.  What has become a pipe must not be waited for.
FileStamp fresh_stamp(const std::filesystem::path& file) {
  const Descriptor opened(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  return FileStamp(file);
}

}  // namespace

// Who looks before reading misses nothing.
LiveShow::LiveShow(const std::filesystem::path& file, int threads) : file_(file), watch_(file) {
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
    {
      std::unique_lock lock(mutex_);
      if (news_.wait_for(lock, kLook, [&] { return stopped_; })) return;
    }
    if (watch_.is_written()) reload();
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
    return Made{result_on(maker_,
                          [&] {
                            return pictures_->make(read_request(parameters, pictures_->show()),
                                                   turns_.stop());
                          }),
                revision};
  } catch (const RenderStopped&) {
    return std::nullopt;
  }
}

void LiveShow::with_pictures(const std::function<void(LivePictures&)>& use) {
  const NewestFirst::Turn turn = turns_.enter(NewestFirst::own_ticket());
  if (turn != NewestFirst::Turn::kNow) throw TemporaryError("the preview ends");
  const HeldTurn held(turns_);
  result_on(maker_, [&] { use(*pictures_); });
}

FileWatch::FileWatch(std::filesystem::path file)
    : file_(std::move(file)), told_(fresh_stamp(file_)), seen_(told_) {}

bool FileWatch::is_written() {
  const FileStamp now = fresh_stamp(file_);
  const bool is_calm = now == std::exchange(seen_, now);
  if (!is_calm || now == told_) return false;
  told_ = now;
  return true;
}

bool NewestFirst::is_outdated(const Ticket& ticket) const {
  const auto newest = newest_.find(ticket.name);
  return newest != newest_.end() && newest->second > ticket.number;
}

NewestFirst::Turn NewestFirst::enter(const Ticket& ticket) {
  // Names are remembered, so that an old request that arrives late is known, but not for ever.
  constexpr std::size_t kMostNames = 256;
  std::unique_lock lock(mutex_);
  const bool own = ticket.name.empty();
  if (is_outdated(ticket)) return Turn::kOutdated;
  if (ended_ || (waiting_ >= kMostWaiting && !own)) return Turn::kTooMany;
  if (newest_.size() >= kMostNames && waiting_ == 0) newest_.clear();
  if (!own) {
    long& newest = newest_[ticket.name];
    newest = std::max(newest, ticket.number);
  }
  if (busy_ && made_.can_stop && (!ticket.can_stop || made_.name == ticket.name)) stop_ = true;
  changed_.notify_all();
  ++waiting_;
  changed_.wait(lock, [&] { return !busy_ || ended_ || is_outdated(ticket); });
  --waiting_;
  if (ended_) return Turn::kTooMany;
  if (is_outdated(ticket)) return Turn::kOutdated;
  busy_ = true;
  made_ = ticket;
  stop_ = false;
  return Turn::kNow;
}

void NewestFirst::leave() {
  const std::lock_guard lock(mutex_);
  busy_ = false;
  stop_ = ended_;
  changed_.notify_all();
}

void NewestFirst::end() {
  const std::lock_guard lock(mutex_);
  ended_ = stop_ = true;
  changed_.notify_all();
}

}  // namespace domefall
