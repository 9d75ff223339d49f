// A LiveShow is a show file as it stands in its author's editor.  It has the last version that is
// right, and says what is wrong with the file now.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "pipeline/preview/file_watch.h"
#include "pipeline/preview/live_pictures.h"
#include "pipeline/preview/newest_first.h"

namespace domefall {

class LiveShow {
 public:
  // Reads the show, which must be right, and goes on to read it whenever it is written.  Throws as
  // read_show, LivePictures and FileWatch.
  LiveShow(const std::filesystem::path& file, int threads);
  ~LiveShow();
  LiveShow(const LiveShow&) = delete;
  LiveShow(LiveShow&&) = delete;
  LiveShow& operator=(const LiveShow&) = delete;
  LiveShow& operator=(LiveShow&&) = delete;

  struct Version {
    int revision = 1;                  // grows with each good version
    int readings = 1;                  // grows whenever the file is read
    std::shared_ptr<const Show> show;  // the last good one
    std::string mistake;               // what is wrong with the file now; empty if it is right
    std::string display, view;         // of the usual grade
  };
  Version version() const;

  // Waits until Version::readings is another number than the caller knows, or until so many seconds
  // have passed.
  Version changed_since(int readings, int seconds) const;

  // Makes a picture when it is its turn.  Returns nothing if it is outdated before it is made, or
  // given up.  Throws as LivePictures, and TemporaryError where too many wait.
  struct Made {
    LivePicture picture;
    int revision = 0;
  };
  std::optional<Made> picture(const Parameters& parameters, const NewestFirst::Ticket& ticket);

  // Calls use(pictures) while no picture is being made.
  void with_pictures(const std::function<void(LivePictures&)>& use);

  int threads() const { return threads_; }
  // Ends all waiting and all pictures, for good.
  void stop();

 private:
  void watch();
  void reload();
  void tell(const std::string& mistake);

  std::filesystem::path file_;
  mutable std::mutex mutex_;  // of what follows
  mutable std::condition_variable news_;
  Version version_;
  bool stopped_ = false;

  NewestFirst turns_;  // who has the pictures
  std::unique_ptr<LivePictures> pictures_;
  int threads_ = 0;
  std::optional<FileWatch> watch_;  // for the thread that watches
  std::thread watching_;
};

}  // namespace domefall
