// Sheets that somebody looks at: each is folded by a process of its own, which can be ended.
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

/// One at a time, the newest request first: a large sheet takes minutes, and who asked before has
/// often gone on to another one. Of more than kMostWaiting the oldest is refused. For any number of
/// threads.
class FoldedSheets {
 public:
  static constexpr std::size_t kMostWaiting = 8;

  /// A program and its arguments that write the report's data of one draw to standard output, as
  /// JSON, or a sentence to standard error.
  using Command = std::function<std::vector<std::string>(std::uint64_t draw)>;
  explicit FoldedSheets(Command command) : command_(std::move(command)) {}

  /// JSON: {"detail": of ReportDetails, "identity": of its campaign}; or, with status 503,
  /// {"problem": a sentence}. `has_gone`: whether nobody waits for it any more, which ends it.
  PageResponse sheet(std::uint64_t draw, const std::function<bool()>& has_gone);
  /// What is under way ends, and nothing begins any more.
  void end();

 private:
  bool wait_for_turn(const std::function<bool()>& has_gone);
  PageResponse folded(std::uint64_t draw, const std::function<bool()>& has_gone);
  bool has_ended();

  const Command command_;
  std::mutex asking_;  // of what follows
  std::condition_variable changes_;
  std::set<std::uint64_t> waiting_;  // numbers of requests
  std::uint64_t requests_ = 0;
  bool is_folding_ = false, has_ended_ = false;
};

}  // namespace misalign::search
