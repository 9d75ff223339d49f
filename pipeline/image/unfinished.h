// This is a list of what would stay behind if the program ended now, files under temporary names
// and scratch folders.  A signal can thus end the program at any moment and leave nothing.
#pragma once

#include <filesystem>
#include <mutex>

namespace domefall {

// While this lives, remove_unfinished() waits.  Whoever makes something unfinished, names it or
// removes it does so under one, so that the list and the disk agree.
class UnfinishedList {
 public:
  UnfinishedList();
  void add(const std::filesystem::path& path);
  // Takes from the list what is finished, or removed.
  void drop(const std::filesystem::path& path);

 private:
  std::unique_lock<std::mutex> held_;
};

// Removes all that is unfinished, folders with what they hold.  Whoever begins or finishes
// something afterwards waits for ever, because this is for a program that is about to end.
void remove_unfinished() noexcept;

}  // namespace domefall
