#include "pipeline/httplib_server/patient_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <string>

namespace domefall {
namespace {

// Says whether the connection is ready for any of the events, or is closed, within so many
// milliseconds.
bool is_ready(socket_t connection, short events, int milliseconds) {
  pollfd polled{connection, events, 0};
  int found;
  do found = poll(&polled, 1, milliseconds);
  while (found < 0 && errno == EINTR);
  return found > 0;
}

// Finds the address and port of one end of a connection, by getpeername or getsockname.
template <class End>
void find_address(const End& end, socket_t connection, std::string& ip, int& port) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  if (end(connection, reinterpret_cast<sockaddr*>(&address), &size) != 0) return;
  std::array<char, INET_ADDRSTRLEN> text{};
  if (!inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size())) return;
  ip = text.data();
  port = ntohs(address.sin_port);
}

// This is what comes and goes through one connection.  It has a buffer because httplib reads byte
// by byte.  begin_request() must be called before each request.
class Connection final : public httplib::Stream {
  using Clock = std::chrono::steady_clock;

 public:
  Connection(socket_t socket, int read_patience_ms, int write_patience_ms)
      : socket_(socket), read_patience_(read_patience_ms), write_patience_(write_patience_ms) {}

  void begin_request() {
    taken_ = 0;
    end_of_patience_ = Clock::now() + std::chrono::milliseconds(read_patience_);
  }
  // Says whether bytes of a further request have come already.
  bool holds_bytes() const { return begin_ < end_; }

  // A client that sends its request byte by byte has no more time than others.
  bool is_readable() const override {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end_of_patience_ - Clock::now());
    return left.count() > 0 && is_ready(socket_, POLLIN, static_cast<int>(left.count()));
  }
  bool is_writable() const override { return is_ready(socket_, POLLOUT, write_patience_); }

  ssize_t read(char* bytes, std::size_t size) override {
    size = std::min(size, PatientServer::kLongestRequest - taken_);
    if (size == 0) return -1;
    if (!holds_bytes()) {
      if (!is_readable()) return -1;
      const ssize_t came = recv(socket_, buffer_.data(), buffer_.size(), 0);
      if (came <= 0) return came;
      begin_ = 0;
      end_ = static_cast<std::size_t>(came);
    }
    const std::size_t count = std::min(size, end_ - begin_);
    std::copy_n(buffer_.data() + begin_, count, bytes);
    begin_ += count;
    taken_ += count;
    return static_cast<ssize_t>(count);
  }

  ssize_t write(const char* bytes, std::size_t size) override {
    return is_writable() ? send(socket_, bytes, size, MSG_NOSIGNAL) : -1;
  }

  void get_remote_ip_and_port(std::string& ip, int& port) const override {
    find_address(getpeername, socket_, ip, port);
  }
  void get_local_ip_and_port(std::string& ip, int& port) const override {
    find_address(getsockname, socket_, ip, port);
  }
  socket_t socket() const override { return socket_; }

 private:
  socket_t socket_;
  int read_patience_, write_patience_;
  std::array<char, 4096> buffer_{};
  std::size_t begin_ = 0, end_ = 0;  // of what is in the buffer
  std::size_t taken_ = 0;            // of the request
  Clock::time_point end_of_patience_;
};

int milliseconds(time_t seconds, time_t microseconds) {
  return static_cast<int>(seconds * 1000 + microseconds / 1000);
}

}  // namespace

bool PatientServer::process_and_close_socket(socket_t socket) {
  Connection connection(socket, milliseconds(read_timeout_sec_, read_timeout_usec_),
                        milliseconds(write_timeout_sec_, write_timeout_usec_));
  const int patience = milliseconds(keep_alive_timeout_sec_, 0);
  bool answered = false;
  for (std::size_t left = keep_alive_max_count_; left > 0 && svr_sock_ != INVALID_SOCKET; --left) {
    if (!connection.holds_bytes() && !is_ready(socket, POLLIN, patience)) break;
    connection.begin_request();
    bool closed = false;
    answered = process_request(connection, left == 1, closed, nullptr);
    if (!answered || closed) break;
  }
  shutdown(socket, SHUT_RDWR);
  close(socket);
  return answered;
}

}  // namespace domefall
