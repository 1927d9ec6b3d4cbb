// Limits how long a connection may take. cpp-httplib's own timeouts are each read's and each
// write's, of which a request that comes a byte a second has thousands.
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
  double request_s = 5;   ///< until its request is whole
  double answer_s = 120;  ///< until all is over
};

/// Ends connections to a port of this process that take longer, of the oldest `served_at_once`:
/// those behind them wait to be served, which is not their fault. It looks from the start to the
/// end of its life, some times a second.
class ConnectionPatience {
 public:
  ConnectionPatience(int port, std::size_t served_at_once, const PatienceOptions& options = {});

  /// The request that came from this port of the other side is whole.
  void heard(int peer_port);
  /// Whether the other side of a connection, which its server keeps open, has closed its end.
  bool has_gone(int peer_port) const;

 private:
  using Clock = std::chrono::steady_clock;
  void look();

  const int port_;
  const std::size_t served_at_once_;
  const PatienceOptions options_;
  std::map<std::uint64_t, Clock::time_point> begins_;  // by the socket's number
  std::mutex hearing_;                                 // of what follows
  std::set<int> heard_;                                // ports of the other sides
  std::jthread looking_;                               // the last: it ends first
};

}  // namespace misalign::search
