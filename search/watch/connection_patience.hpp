// Limits the time of a connection. cpp-httplib has timeouts for single reads and writes alone, and
// a slow request may have thousands.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <stop_token>
#include <thread>

namespace misalign::search {

struct PatienceOptions {
  double request_s = 5;   ///< time until the request is complete
  double answer_s = 120;  ///< time until the answer is sent
};

/// Ends connections to a port of this process that take longer. It checks the oldest
/// `served_at_once`, some times a second: the others still wait to be served.
class ConnectionPatience {
 public:
  ConnectionPatience(int port, std::size_t served_at_once, const PatienceOptions& options = {});

  /// Notes that the request from this port of the client is complete.
  void heard(int peer_port);
  /// Returns whether the client has closed its end of a connection.
  bool has_gone(int peer_port) const;

 private:
  using Clock = std::chrono::steady_clock;
  void look();

  const int port_;
  const std::size_t served_at_once_;
  const PatienceOptions options_;
  std::map<std::uint64_t, Clock::time_point> begins_;  // keyed by the socket's number
  std::mutex hearing_;                                 // guards heard_
  std::set<int> heard_;                                // ports of clients with complete requests
  std::jthread looking_;                               // the last: it ends first
};

}  // namespace misalign::search
