// The preview is served over HTTP on 127.0.0.1.  cpp-httplib, which speaks HTTP, brings OpenSSL and
// Brotli, so what calls it is a library of its own, libdomefall_httplib_server.so
// (pipeline/httplib_server), which is loaded when a preview is served.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/image/late_library.h"

namespace domefall {

class HttpRequest : public Interface {
 public:
  virtual const std::string& method() const = 0;
  virtual const std::string& path() const = 0;  // decoded, without the question mark's part
  virtual std::string header(const std::string& name) const = 0;  // empty if there is none
  virtual std::optional<std::string> parameter(std::string_view name) const = 0;
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

class HttpServer : public Interface {
 public:
  virtual int port() const = 0;

  // Serves until stop() is called, by any thread.
  virtual void serve() = 0;
  virtual void stop() = 0;
};

class HttpServers : public Interface {
 public:
  virtual std::unique_ptr<HttpServer> bind(int port, const HttpHeaders& always,
                                           HttpHandler handler) const = 0;
};

// Binds a server to `port`, or to one of its own choice if that is 0.  It serves once serve() is
// called.  Each answer has the headers `always`.  A client that sends more than 64 KiB in a
// request, or takes longer than two seconds for it, loses its connection.  Throws as load_library,
// and TemporaryError if the port is taken.
std::unique_ptr<HttpServer> bind_http_server(int port, const HttpHeaders& always,
                                             HttpHandler handler);

}  // namespace domefall
