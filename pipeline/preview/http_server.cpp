#include "pipeline/preview/http_server.h"

namespace domefall {

std::unique_ptr<HttpServer> bind_http_server(int port, const HttpHeaders& always,
                                             HttpHandler handler) {
  static const auto& servers = static_cast<const HttpServers&>(load_library(
      "libdomefall_httplib_server.so", "domefall_httplib_server", "serves the preview"));
  return servers.bind(port, always, std::move(handler));
}

}  // namespace domefall
