// A LiveShow is a show file as it stands in its author's editor.  It has the last version that is
// right, and says what is wrong with the file now.
#pragma once

#include <atomic>
#include <boost/asio/thread_pool.hpp>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "pipeline/program/preview/live_pictures.h"
#include "pipeline/render/file_stamp.h"

namespace domefall {

// A FileWatch tells when a file has been written anew.  It looks at the file itself, since the system tells of no changes that another machine makes (on
// NFS, SMB, FUSE and the shared folders of virtual machines).  A link counts as the file that it
// leads to, and no file is a state like others.
class FileWatch {
 public:
  explicit FileWatch(std::filesystem::path file);

  // Looks, and says whether the file is another one than when this last said so, or than at the
  // beginning.  A file that has changed since the look before may not be written to its end yet,
  // and is told of by the next look that finds it unchanged.
  bool is_written();

 private:
  std::filesystem::path file_;
  FileStamp told_, seen_;
};

// NewestFirst says who may have a picture made, of those who wait for one.  The newest request of
// each client wins, and nothing queues.
class NewestFirst {
 public:
  // A Ticket is for a client's picture, or for one of two kinds that it has made side by side.
  // `number` grows with each request of that name.
  struct Ticket {
    std::string name;
    long number = 0;
    // This says whether what is made gives way to a newer one of that name, and to all that cannot
    // be stopped themselves, which are soon done.
    bool can_stop = false;
  };

  enum class Turn { kNow, kOutdated, kTooMany };

  // Returns a ticket of the program itself, which waits as long as it must.
  static Ticket own_ticket() { return {}; }

  // Waits until no other picture is made.  After kNow the caller makes its own and then calls
  // leave().  kOutdated says that a newer request of that name has come.  kTooMany says that
  // kMostWaiting wait already, or that end() was called.
  Turn enter(const Ticket& ticket);
  void leave();
  // From now on nobody gets a turn, and what is made is to give way.
  void end();

  // This is set while the picture that is made is to give way.
  const std::atomic<bool>& stop() const { return stop_; }

  static constexpr int kMostWaiting = 32;

 private:
  bool is_outdated(const Ticket& ticket) const;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, long> newest_;
  int waiting_ = 0;
  bool busy_ = false, ended_ = false;
  Ticket made_;  // whose turn it is, while busy_
  std::atomic<bool> stop_ = false;
};

class LiveShow {
 public:
  // Reads the show, which must be right, and goes on to read it whenever it is written.  Throws as
  // read_show and LivePictures.
  LiveShow(const std::filesystem::path& file, int threads);
  ~LiveShow();
  LiveShow(const LiveShow&) = delete;
  LiveShow& operator=(const LiveShow&) = delete;

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

  void with_pictures(const std::function<void(LivePictures&)>& use);

  int threads() const { return threads_; }
  // Ends all waiting and all pictures, for good.
  void stop();

 private:
  void watch();
  void reload();

  std::filesystem::path file_;
  mutable std::mutex mutex_;  // of what follows
  mutable std::condition_variable news_;
  Version version_;
  bool stopped_ = false;

  NewestFirst turns_;  // who has the pictures
  std::unique_ptr<LivePictures> pictures_;
  // All pictures are made on one thread, since each thread that has made one keeps memory for more.
  boost::asio::thread_pool maker_{1};
  int threads_ = 0;
  FileWatch watch_;  // for the thread that watches
  std::thread watching_;
};

}  // namespace domefall
