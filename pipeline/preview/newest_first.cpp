#include "pipeline/preview/newest_first.h"

#include <algorithm>

namespace domefall {

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
