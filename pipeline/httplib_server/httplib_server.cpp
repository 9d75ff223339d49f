#include <fmt/format.h>
#include <httplib.h>
#include <sys/resource.h>

#include <algorithm>

#include "pipeline/httplib_server/patient_server.h"
#include "pipeline/image/errors.h"
#include "pipeline/preview/http_server.h"

namespace domefall {
namespace {

// At most this many connections are served at once.  Most of them only wait, for news or for their
// turn.
constexpr std::size_t kConnections = 48;
constexpr int kPatienceSeconds = 2;         // with a slow or silent client
constexpr std::size_t kLongestBody = 1024;  // no request has one

// httplib waits by select(), which knows no descriptor beyond 1023.
void limit_descriptors() {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, FD_SETSIZE - 1);
  setrlimit(RLIMIT_NOFILE, &limit);
}

class HttplibRequest : public HttpRequest {
 public:
  explicit HttplibRequest(const httplib::Request& request) : request_(request) {}

  const std::string& method() const override { return request_.method; }
  const std::string& path() const override { return request_.path; }
  std::string header(const std::string& name) const override {
    return request_.get_header_value(name);
  }
  std::optional<std::string> parameter(std::string_view name) const override {
    const auto found = request_.params.find(std::string(name));
    if (found == request_.params.end()) return std::nullopt;
    return found->second;
  }

 private:
  const httplib::Request& request_;
};

void send_answer(const HttpAnswer& answer, httplib::Response& response) {
  // httplib answers 200, or 206 where a part was asked for, if nothing else is set.
  if (answer.status != 200) response.status = answer.status;
  for (const auto& [name, value] : answer.headers) response.set_header(name, value);
  if (!answer.type.empty()) response.set_content(answer.body, answer.type);
}

class HttplibServer : public HttpServer {
 public:
  HttplibServer(int wanted_port, const HttpHeaders& always, HttpHandler handler)
      : handler_(std::move(handler)) {
    limit_descriptors();
    http_.new_task_queue = [] { return new httplib::ThreadPool(kConnections); };
    http_.set_read_timeout(kPatienceSeconds);
    http_.set_write_timeout(kPatienceSeconds);
    http_.set_keep_alive_timeout(kPatienceSeconds);
    http_.set_keep_alive_max_count(1'000'000);
    http_.set_payload_max_length(kLongestBody);
    http_.set_tcp_nodelay(true);
    // httplib's own options let a second program take the same port.
    http_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    http_.set_default_headers(httplib::Headers(always.begin(), always.end()));
    // A request is answered before httplib looks for a route, so that its path meets no regular
    // expression.
    http_.set_pre_routing_handler([this](const auto& request, auto& response) {
      send_answer(handler_(HttplibRequest(request)), response);
      return httplib::Server::HandlerResponse::Handled;
    });
    if (wanted_port == 0)
      port_ = http_.bind_to_any_port("127.0.0.1");
    else
      port_ = http_.bind_to_port("127.0.0.1", wanted_port) ? wanted_port : -1;
    if (port_ <= 0)
      throw TemporaryError(fmt::format("127.0.0.1:{}: the port cannot be had", wanted_port));
  }

  int port() const override { return port_; }
  void serve() override { http_.listen_after_bind(); }
  void stop() override { http_.stop(); }

 private:
  HttpHandler handler_;
  PatientServer http_;
  int port_ = 0;
};

class HttplibServers : public HttpServers {
 public:
  std::unique_ptr<HttpServer> bind(int port, const HttpHeaders& always,
                                   HttpHandler handler) const override {
    return std::make_unique<HttplibServer>(port, always, std::move(handler));
  }
};

}  // namespace
}  // namespace domefall

extern "C" const domefall::Interface* domefall_httplib_server() {
  static const domefall::HttplibServers servers;
  return &servers;
}
