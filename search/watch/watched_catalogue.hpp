// Watches a catalogue that a search may be writing.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "search/report/report_data.hpp"
#include "search/watch/file_mark.hpp"
#include "search/watch/folded_sheets.hpp"
#include "search/watch/page_response.hpp"

namespace misalign::search {

/// Never makes a writer wait: the catalogue is open only while it is being read. It is read on
/// request if the file has changed, by one thread at a time, in short transactions, within a small
/// share of a core's time; other requests get the last answer. A fault of the file is the answer as
/// long as it lasts. Safe for any number of threads.
class WatchedCatalogue {
 public:
  /// UserError: failure if the program has no page; bad_request if the file system is shared;
  /// bad_input if it is no catalogue, is damaged, or its directory does not exist; in_use if a
  /// writer excludes readers; foreign if its schema is newer. A file may appear later.
  WatchedCatalogue(const std::string& path, schema::NameParameter name_parameter,
                   FoldedSheets::Command folds_sheet = {});

  bool exists() const { return FileMark::of(call_.path).exists(); }
  /// Returns the report's page, which requests live() every second.
  PageResponse page();
  /// Returns live_state_json with "writing": true while a search is at work, and "read_at_s": the
  /// time of reading on a monotonic clock; or, with status 503, {"problem": a sentence}.
  PageResponse live();
  /// Returns the answer of FoldedSheets.
  PageResponse sheet(std::uint64_t draw, const std::function<bool()>& has_gone);
  /// Ends work under way soon, with a sentence.
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  struct Kept {
    std::mutex asking;      // guards response and rests_until
    bool waits = false;     // true to wait for another reader instead of giving an old answer
    PageResponse response;  // no body before the first answer
    FileMark mark;
    Clock::time_point rests_until;
  };
  using Maker = std::function<PageResponse(const FileMark& mark)>;
  PageResponse response(Kept& kept, double share_of_core, const Maker& make);
  PageResponse page_about(const std::string& problem) const;
  void check_readable(const FileMark& mark) const;

  const schema::NameParameter name_parameter_;
  std::atomic<bool> has_ended_ = false;
  const ReportCall call_;
  std::timed_mutex reading_;  // held while the file is open
  FoldedSheets sheets_;
  Kept page_, live_;
};

}  // namespace misalign::search
