#include "pipeline/preview/http_server.h"

namespace domefall {

std::unique_ptr<HttpServer> bind_http_server(int port, const HttpHeaders& always,
                                             HttpHandler handler) {
  static const auto& servers =
      late_library<HttpServers>("domefall_httplib_server", "serves the preview");
  return servers.bind(port, always, std::move(handler));
}

}  // namespace domefall
