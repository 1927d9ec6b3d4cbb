// A catalogue that is looked at again and again while a search may be writing it.
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

/// Nobody who writes the catalogue waits for it: it is open only while it is being read, which is
/// done when somebody asks and the file has changed, by one at a time, in short transactions, and
/// never for more than a small share of a core's time: who asks in between is told what was read
/// last. What goes wrong with the file is what is told, as long as it does. For any number of
/// threads.
class WatchedCatalogue {
 public:
  /// UserError: failure the program carries no page; bad_request the file system is shared;
  /// bad_input it is no catalogue, is damaged, or not even its directory is there; in_use it is
  /// being written where nobody may read meanwhile; foreign a newer schema. A file that is not
  /// there yet is waited for.
  WatchedCatalogue(const std::string& path, schema::NameParameter name_parameter,
                   FoldedSheets::Command folds_sheet = {});

  bool exists() const { return FileMark::of(call_.path).exists(); }
  /// The report's page, which asks for live() every second.
  PageResponse page();
  /// JSON: live_state_json with "writing": whether a search is at work, "read_at_s": when this was
  /// read, in seconds that only go on; or, with status 503, {"problem": a sentence}.
  PageResponse live();
  /// As FoldedSheets has it.
  PageResponse sheet(std::uint64_t draw, const std::function<bool()>& has_gone);
  /// What is under way ends soon, with a sentence.
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  struct Kept {
    std::mutex asking;      // of what follows
    bool waits = false;     // for others that read, rather than telling what is old
    PageResponse response;  // without a body before the first time
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
  std::timed_mutex reading_;  // the file is open
  FoldedSheets sheets_;
  Kept page_, live_;
};

}  // namespace misalign::search
