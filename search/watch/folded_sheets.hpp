// Folds requested sheets, each in a process of its own, which can be ended.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "search/watch/page_response.hpp"

namespace misalign::search {

/// Folds one sheet at a time, the newest request first: a large sheet takes minutes, and older
/// requests are often obsolete. The oldest of more than kMostWaiting is refused. Safe for any
/// number of threads.
class FoldedSheets {
 public:
  static constexpr std::size_t kMostWaiting = 8;

  /// Returns a program and its arguments. It writes the report's data of one draw as JSON to
  /// standard output, or a sentence to standard error.
  using Command = std::function<std::vector<std::string>(std::uint64_t draw)>;
  explicit FoldedSheets(Command command) : command_(std::move(command)) {}

  /// Returns JSON: {"detail": of ReportDetails, "identity": of its campaign}; or, with status 503,
  /// {"problem": a sentence}. The work ends once `has_gone` returns true: the client is gone.
  PageResponse sheet(std::uint64_t draw, const std::function<bool()>& has_gone);
  /// Ends the work under way, and refuses further requests.
  void end();

 private:
  bool wait_for_turn(const std::function<bool()>& has_gone);
  PageResponse folded(std::uint64_t draw, const std::function<bool()>& has_gone);
  bool has_ended();

  const Command command_;
  std::mutex asking_;  // guards the members below
  std::condition_variable changes_;
  std::set<std::uint64_t> waiting_;  // numbers of requests
  std::uint64_t requests_ = 0;
  bool is_folding_ = false, has_ended_ = false;
};

}  // namespace misalign::search
