#include "pipeline/program/preview/http_server.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <charconv>
#include <chrono>
#include <limits>

#include "pipeline/base/errors.h"
#include "pipeline/base/utf8.h"

namespace domefall {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace net = boost::asio;
using net::ip::tcp;
using Failure = beast::error_code;

constexpr int kMostConnections = 256;  // further ones wait to be accepted
// So many answers are made at once.  Most of them only wait, for news or for their turn.
constexpr std::size_t kAnswers = 48;
constexpr std::size_t kLongestRequest = 65'536;  // bytes
constexpr std::chrono::seconds kRequestPatience{2};
constexpr std::chrono::seconds kAnswerPatience{60};  // a large picture through a slow tunnel

std::string decoded(std::string_view text) {
  std::string plain;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char* digits = text.data() + at + 1;
    unsigned code = 0;
    if (text[at] == '%' && at + 2 < text.size() &&
        std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      plain += static_cast<char>(code);
      at += 2;
    } else {
      plain += text[at] == '+' ? ' ' : text[at];
    }
  }
  return plain;
}

HttpRequest::Words parameters_in(std::string_view query) {
  HttpRequest::Words parameters;
  while (!query.empty()) {
    const std::string_view part = query.substr(0, query.find('&'));
    const std::size_t equals = std::min(part.find('='), part.size());
    parameters.emplace(decoded(part.substr(0, equals)),
                       decoded(part.substr(std::min(equals + 1, part.size()))));
    query.remove_prefix(std::min(part.size() + 1, query.size()));
  }
  return parameters;
}

// Beast's own views of text are of another type in each of its versions.
std::string_view std_view(beast::string_view text) { return {text.data(), text.size()}; }

HttpRequest plain_request(const http::request_parser<http::empty_body>& parser) {
  const auto& from = parser.get();
  const std::string_view target = std_view(from.target());
  const std::size_t question = std::min(target.find('?'), target.size());
  HttpRequest request;
  request.method = std_view(from.method_string());
  request.path = target.substr(0, question);
  request.parameters = parameters_in(target.substr(std::min(question + 1, target.size())));
  // The parser is not done before a body that it knows the end of.
  request.has_body = !parser.is_done() || from.count(http::field::transfer_encoding) > 0;
  for (const auto& field : from) {
    std::string& value = request.headers[in_lower_case(std_view(field.name_string()))];
    value += (value.empty() ? "" : ", ") + std::string(std_view(field.value()));
  }
  return request;
}

// This is what all connections share.  All but the answers is made on the thread that runs `io`.
struct Serving {
  HttpHandler handler;
  HttpHeaders always;
  int connections = 0;
  net::io_context io{1};
  net::thread_pool answers{kAnswers};
};

// A Connection lives as long as it waits for something: its functions pass it on.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, Serving& serving) : stream_(std::move(socket)), serving_(serving) {
    ++serving_.connections;
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() { --serving_.connections; }

  void read() {
    parser_.emplace();
    parser_->header_limit(kLongestRequest);
    parser_->body_limit(std::numeric_limits<std::uint64_t>::max());  // none is read
    stream_.expires_after(kRequestPatience);
    http::async_read_header(
        stream_, buffer_, *parser_,
        [self = shared_from_this()](Failure failure, std::size_t) { self->answer(failure); });
  }

 private:
  void answer(Failure failure) {
    const Failure ended = http::error::end_of_stream;
    if (failure && (failure == ended || failure.category() != ended.category())) return;
    if (failure)
      return write({400, "text/plain; charset=utf-8",
                    "this is no request of HTTP/1, or is longer than 64 KiB\n"});
    net::post(serving_.answers, [self = shared_from_this()]() mutable {
      Serving& serving = self->serving_;
      HttpAnswer made = serving.handler(plain_request(*self->parser_));
      // The connection is handed back whole, so that it also ends where it is used.
      net::post(serving.io, [self = std::move(self), made = std::move(made)]() mutable {
        self->write(std::move(made));
      });
    });
  }

  void write(HttpAnswer answer) {
    const auto& request = parser_->get();
    response_ = {};
    response_.version(request.version());
    response_.result(static_cast<unsigned>(answer.status));
    for (const HttpHeaders& headers : {serving_.always, answer.headers})
      for (const auto& [name, value] : headers) response_.set(name, value);
    response_.keep_alive(request.keep_alive() && answer.status < 400);
    if (!answer.type.empty()) {
      response_.set(http::field::content_type, answer.type);
      response_.content_length(answer.body.size());
      if (request.method() != http::verb::head) response_.body() = std::move(answer.body);
    } else if (answer.status != 204) {
      response_.content_length(0);
    }
    stream_.expires_after(kAnswerPatience);
    http::async_write(stream_, response_,
                      [self = shared_from_this()](Failure failure, std::size_t) {
                        if (failure) return;
                        if (self->response_.keep_alive()) return self->read();
                        self->end();
                      });
  }

  // The answer would be lost to the client if the connection was closed before what it still sends
  // has been read.
  void end() {
    Failure ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    buffer_.clear();
    stream_.expires_after(kRequestPatience);
    net::async_read(stream_, buffer_.prepare(buffer_.max_size()),
                    [self = shared_from_this()](Failure, std::size_t) {});
  }

  beast::tcp_stream stream_;
  Serving& serving_;
  beast::flat_buffer buffer_{kLongestRequest};
  std::optional<http::request_parser<http::empty_body>> parser_;
  http::response<http::string_body> response_;
};

}  // namespace

std::string HttpRequest::header(std::string_view name) const {
  const auto found = headers.find(name);
  return found == headers.end() ? "" : found->second;
}

std::optional<std::string> HttpRequest::parameter(std::string_view name) const {
  const auto found = parameters.find(name);
  if (found == parameters.end()) return std::nullopt;
  return found->second;
}

struct HttpServer::Inside : Serving {
  tcp::acceptor acceptor{io};
  net::steady_timer pause{io};

  void bind(int port) {
    const tcp::endpoint end(net::ip::address_v4::loopback(), static_cast<std::uint16_t>(port));
    try {
      acceptor.open(end.protocol());
      // A browser that is started must not keep the port.
      fcntl(acceptor.native_handle(), F_SETFD, FD_CLOEXEC);
      acceptor.set_option(net::socket_base::reuse_address(true));
      acceptor.bind(end);
      acceptor.listen();
    } catch (const boost::system::system_error& error) {
      throw TemporaryError(
          fmt::format("127.0.0.1:{}: the port cannot be had: {}", port, error.code().message()));
    }
  }

  void accept() {
    acceptor.async_accept([this](Failure failure, tcp::socket socket) {
      if (!failure) {
        Failure ignored;
        socket.set_option(tcp::no_delay(true), ignored);
        std::make_shared<Connection>(std::move(socket), *this)->read();
      }
      if (!failure && connections < kMostConnections) return accept();
      // Descriptors or places come back as others end.
      pause.expires_after(std::chrono::milliseconds(20));
      pause.async_wait([this](Failure) { accept(); });
    });
  }
};

HttpServer::HttpServer(int port, HttpHeaders always, HttpHandler handler)
    : inside_(std::make_unique<Inside>()) {
  inside_->handler = std::move(handler);
  inside_->always = std::move(always);
  inside_->bind(port);
}

HttpServer::~HttpServer() = default;

int HttpServer::port() const { return inside_->acceptor.local_endpoint().port(); }

void HttpServer::serve() {
  inside_->accept();
  inside_->io.run();
  inside_->answers.stop();
  inside_->answers.join();
}

void HttpServer::stop() { inside_->io.stop(); }

}  // namespace domefall
