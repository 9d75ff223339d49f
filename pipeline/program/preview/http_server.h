// An HttpServer answers the requests of browsers on 127.0.0.1.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace domefall {

struct HttpRequest {
  using Words = std::map<std::string, std::string, std::less<>>;

  std::string method, path;  // the path as it was sent, without the question mark's part
  Words headers;             // by names in small letters; those of one name are joined by commas
  Words parameters;          // of the question mark's part, decoded; the first of a name counts
  bool has_body = false;     // which is never read

  std::string header(std::string_view name) const;  // empty if there is none
  std::optional<std::string> parameter(std::string_view name) const;
};

using HttpHeaders = std::vector<std::pair<std::string, std::string>>;

struct HttpAnswer {
  int status = 200;
  std::string type, body;  // an empty type means no body
  HttpHeaders headers = {};
};

// A handler is called by several threads at once, for each request that is well-formed, and throws
// nothing.
using HttpHandler = std::function<HttpAnswer(const HttpRequest&)>;

// A client that sends more than 64 KiB in a request, or takes longer than two seconds until it is
// whole, loses its connection.  So does one whose request is refused (a status of 400 or more) or
// has a body.  Otherwise what it sends as a body would be read as its next request.
class HttpServer {
 public:
  // Binds a server to `port`, or to one of its own choice if that is 0.  It serves once serve() is
  // called.  Each answer has the headers `always`.  Throws TemporaryError if the port is taken.
  HttpServer(int port, HttpHeaders always, HttpHandler handler);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  int port() const;

  // Serves until stop() is called, by any thread, and the answers that are being made are there.
  void serve();
  void stop();

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace domefall
