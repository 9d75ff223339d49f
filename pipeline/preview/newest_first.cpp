#include "pipeline/preview/newest_first.h"

#include <algorithm>

namespace domefall {

bool NewestFirst::is_outdated(const Ticket& ticket) const {
  const auto newest = newest_.find(ticket.name);
  return newest != newest_.end() && newest->second > ticket.number;
}

NewestFirst::Turn NewestFirst::enter(const Ticket& ticket) {
  // Names are remembered, so that an old request that arrives late is known; but not for ever.
  constexpr std::size_t kMostNames = 256;
  std::unique_lock lock(mutex_);
  if (is_outdated(ticket)) return Turn::kOutdated;
  if (waiting_ >= kMostWaiting) return Turn::kTooMany;
  if (newest_.size() >= kMostNames && waiting_ == 0) newest_.clear();
  long& newest = newest_[ticket.name];
  newest = std::max(newest, ticket.number);
  if (busy_ && can_stop_) stop_ = true;
  changed_.notify_all();
  ++waiting_;
  changed_.wait(lock, [&] { return !busy_ || is_outdated(ticket); });
  --waiting_;
  if (is_outdated(ticket)) return Turn::kOutdated;
  busy_ = true;
  can_stop_ = ticket.can_stop;
  stop_ = false;
  return Turn::kNow;
}

void NewestFirst::leave() {
  const std::lock_guard lock(mutex_);
  busy_ = false;
  stop_ = false;
  changed_.notify_all();
}

}  // namespace domefall
