// A PatientServer is an HTTP server whose clients have bounds, on the bytes of a request and on the
// time they take.
#pragma once

#include <httplib.h>

#include <cstddef>

namespace domefall {

// httplib's server limits the length of a body and the silence between two bytes.  It limits
// neither the length of a line nor the number of header lines, nor how long a request takes in
// whole.  One connection could fill the memory, and a few slow ones hold all threads.  Here a
// request that is longer than kLongestRequest, or takes longer than the read timeout, ends its
// connection.
class PatientServer final : public httplib::Server {
 public:
  static constexpr std::size_t kLongestRequest = 65'536;  // bytes, of all lines and the body

 private:
  // Answers the requests of one connection, one after the other, then closes it.
  bool process_and_close_socket(socket_t socket) override;
};

}  // namespace domefall
