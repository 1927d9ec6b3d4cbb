#include "search/watch/connection_patience.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <filesystem>
#include <utility>
#include <vector>

namespace misalign::search {
namespace {

constexpr std::chrono::milliseconds kPollInterval{200};

struct Connection {
  int descriptor;
  std::uint64_t number;  // the socket's inode, unique while it is open
  int peer_port;
  std::chrono::steady_clock::time_point begin{};
};

using AskForName = int (*)(int, sockaddr*, socklen_t*);

// Returns the port, or 0 without one, such as for no socket, or the peer of a listening socket.
int port_of(AskForName ask, int descriptor) {
  sockaddr_storage name{};
  socklen_t size = sizeof name;
  if (ask(descriptor, reinterpret_cast<sockaddr*>(&name), &size) != 0) return 0;
  if (name.ss_family == AF_INET) return ntohs(reinterpret_cast<sockaddr_in&>(name).sin_port);
  if (name.ss_family == AF_INET6) return ntohs(reinterpret_cast<sockaddr_in6&>(name).sin6_port);
  return 0;
}

std::vector<Connection> connections_to(int port) {
  std::vector<Connection> found;
  std::error_code error;
  for (std::filesystem::directory_iterator entry("/proc/self/fd", error), end;
       !error && entry != end; entry.increment(error)) {
    const int descriptor = std::atoi(entry->path().filename().c_str());
    if (port_of(getsockname, descriptor) != port) continue;
    const int peer_port = port_of(getpeername, descriptor);
    struct stat socket {};
    if (peer_port == 0 || fstat(descriptor, &socket) != 0) continue;
    found.push_back({descriptor, socket.st_ino, peer_port});
  }
  return found;
}

}  // namespace

ConnectionPatience::ConnectionPatience(int port, std::size_t served_at_once,
                                       const PatienceOptions& options)
    : port_(port), served_at_once_(served_at_once), options_(options) {
  looking_ = std::jthread([this](const std::stop_token& stop) {
    std::mutex resting;
    std::condition_variable_any rest;
    std::unique_lock lock(resting);
    while (!stop.stop_requested()) {
      look();
      rest.wait_for(lock, stop, kPollInterval, [] { return false; });
    }
  });
}

void ConnectionPatience::heard(int peer_port) {
  const std::lock_guard lock(hearing_);
  heard_.insert(peer_port);
}

bool ConnectionPatience::has_gone(int peer_port) const {
  for (const Connection& connection : connections_to(port_)) {
    char byte = 0;
    if (connection.peer_port != peer_port) continue;
    return recv(connection.descriptor, &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
  }
  return true;
}

void ConnectionPatience::look() {
  std::set<int> gone;  // ports whose connections have closed
  {
    const std::lock_guard lock(hearing_);
    gone = heard_;
  }
  const Clock::time_point now = Clock::now();
  std::vector<Connection> open = connections_to(port_);
  std::map<std::uint64_t, Clock::time_point> begins;
  for (Connection& connection : open) {
    const auto known = begins_.find(connection.number);
    connection.begin = begins[connection.number] = known == begins_.end() ? now : known->second;
    gone.erase(connection.peer_port);
  }
  begins_ = std::move(begins);
  std::sort(open.begin(), open.end(), [](const Connection& a, const Connection& b) {
    return std::pair(a.begin, a.descriptor) < std::pair(b.begin, b.descriptor);
  });
  if (open.size() > served_at_once_) open.resize(served_at_once_);
  const std::lock_guard lock(hearing_);
  for (const int port : gone) heard_.erase(port);
  for (const Connection& connection : open) {
    const double patience_s =
        heard_.contains(connection.peer_port) ? options_.answer_s : options_.request_s;
    if (now - connection.begin < std::chrono::duration<double>(patience_s)) continue;
    // The serving thread notices, and closes the connection.
    shutdown(connection.descriptor, SHUT_RDWR);
  }
}

}  // namespace misalign::search
