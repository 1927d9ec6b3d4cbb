// Serves HTTP on one loopback address; only its source includes cpp-httplib.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "schema/files/user_error.hpp"
#include "search/watch/page_response.hpp"

namespace misalign::search {

/// The port that is tried first if none is given.
inline constexpr int kUsualPort = 8617;

class PageServer {
 public:
  /// Binds to a port of a numeric loopback address; 0: to any free port. Without a port to
  /// kUsualPort, or to any free one if that is taken. UserError (failure) if it cannot.
  PageServer(const std::string& address, std::optional<int> port,
             schema::NameParameter name_parameter);
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  PagePlace place() const;
  /// Answers until stop(), with `handler` if refusal() does not refuse. Headers keep answers from
  /// other sites and from caches. UserError (failure) if connections cannot be accepted.
  void serve(const PageHandler& handler);
  /// Stops the server from another thread. Requests under way are answered; silent clients are
  /// dropped within two seconds.
  void stop();

 private:
  class Impl;
  const std::unique_ptr<Impl> impl_;
};

}  // namespace misalign::search
