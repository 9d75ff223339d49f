// A WarningFinder finds what `check` warns of, for the live preview, while nothing else is to be
// done.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <thread>

#include "pipeline/preview/live_show.h"

namespace domefall {

class WarningFinder {
 public:
  // The show must outlive this.
  explicit WarningFinder(LiveShow& show);
  ~WarningFinder();
  WarningFinder(const WarningFinder&) = delete;
  WarningFinder(WarningFinder&&) = delete;
  WarningFinder& operator=(const WarningFinder&) = delete;
  WarningFinder& operator=(WarningFinder&&) = delete;

  // Returns the warnings of the present version, or says that they are not found yet, as JSON.
  std::string as_json() const;

 private:
  void find();

  LiveShow& show_;
  mutable std::mutex mutex_;  // of the two that follow
  int revision_ = 0;
  std::string found_;
  std::atomic<bool> stop_ = false;
  std::thread finding_;
};

}  // namespace domefall
