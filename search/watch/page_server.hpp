// An HTTP server on one loopback address; cpp-httplib is in its source alone.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "schema/files/user_error.hpp"
#include "search/watch/page_response.hpp"

namespace misalign::search {

/// The port that is tried where none is asked for.
inline constexpr int kUsualPort = 8617;

class PageServer {
 public:
  /// Binds to this port of a loopback address, in numbers; 0: to any that is free. Without one, to
  /// kUsualPort, or to any if that is taken. UserError (failure) if it cannot.
  PageServer(const std::string& address, std::optional<int> port,
             schema::NameParameter name_parameter);
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  PagePlace place() const;
  /// Answers until stop(), by `answer` what refusal() lets through; with headers that keep every
  /// answer from other sites and from caches. UserError (failure) if connections cannot be taken.
  void serve(const PageHandler& handler);
  /// From another thread. Requests under way are answered; whoever says nothing is left within two
  /// seconds.
  void stop();

 private:
  class Impl;
  const std::unique_ptr<Impl> impl_;
};

}  // namespace misalign::search
