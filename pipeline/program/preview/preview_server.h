// A PreviewServer is the live preview of a show for a browser on this machine.  It serves its page,
// and what the page asks for.
//
// It listens on 127.0.0.1 alone.  It answers only requests whose address begins with the token of
// the page's own address, whose Host is this machine, and which no other page has sent (Origin,
// Sec-Fetch-Site), unless somebody follows a link.  It serves its page, pictures and facts of one
// show, and no file.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace domefall {

class PreviewServer {
 public:
  // Reads the show and binds a port of its own choice if `port` is 0.  Throws as LiveShow
  // and HttpServer.
  PreviewServer(const std::filesystem::path& show, int port, int threads);
  ~PreviewServer();
  PreviewServer(const PreviewServer&) = delete;
  PreviewServer& operator=(const PreviewServer&) = delete;

  int port() const;
  // The address is http://127.0.0.1:PORT/TOKEN/.
  const std::string& url() const;

  // Serves until stop() is called, by any thread.
  void serve();
  void stop();

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace domefall
