#include "search/watch/watched_catalogue.hpp"

#include <algorithm>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>

#include "schema/files/file_bytes.hpp"
#include "schema/files/file_name.hpp"
#include "schema/files/storage.hpp"
#include "schema/report/report.hpp"
#include "search/report/live_state.hpp"
#include "search/terminal/build_info.hpp"
#include "search/terminal/failure.hpp"

namespace misalign::search {
namespace {

using schema::Json;

// Largest shares of a core's time, since ranks need the cores.
constexpr double kShareForLive = 0.05, kShareForPages = 0.2;
constexpr double kLeastRest_s = 0.5;
// Largest number of vertices that fold within a second; larger sheets are folded on request.
constexpr int kLargestDetailed = 200;
// Longest wait of a short request while another one reads.
constexpr std::chrono::seconds kSoon{2};

constexpr const char* kHtml = "text/html; charset=utf-8";

// Returns this thread's CPU time, which excludes waiting.
double core_time_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

ReportCall call_for(const std::string& path, const std::atomic<bool>& has_ended) {
  ReportCall call;
  call.path = path;
  call.output = "report.html";
  call.largest_detailed = kLargestDetailed;
  call.only_remembered = true;
  call.is_stopped = [&has_ended] { return has_ended.load(); };
  return call;
}

// Reads byte 18 of SQLite's file format: 1 for a rollback journal, 2 for a write-ahead log.
bool has_write_ahead_log(const std::string& path) {
  std::string begin(20, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin[18] == 2;
}

void check_kind(const std::string& path) {
  schema::check_is_file(path, "give a catalogue that `misalign search` wrote, or will write");
}

void check_storage(const std::string& path) {
  const schema::FileSystem system = schema::file_system_of(schema::end_of_links(path));
  if (system.storage != schema::Storage::network) return;
  throw schema::UserError(schema::Cause::bad_request,
                          path + ": is on shared storage (" + system.name +
                              "; there a reader would block the search); watch a catalogue on a "
                              "local disk, or run `misalign status` now and then");
}

PageResponse html_response(int status, const schema::ServedPage& page) {
  return {status, kHtml, std::make_shared<const std::string>(page.text), page.policy};
}

}  // namespace

WatchedCatalogue::WatchedCatalogue(const std::string& path, schema::NameParameter name_parameter,
                                   FoldedSheets::Command folds_sheet)
    : name_parameter_(name_parameter),
      call_(call_for(path, has_ended_)),
      sheets_(std::move(folds_sheet)) {
  page_.waits = true;
  page_about("");
  check_kind(path);
  check_storage(path);
  const FileMark mark = FileMark::of(path);
  if (mark.exists()) {
    check_readable(mark);
    const auto database = schema::open_for_reading(path);
    schema::read_campaign_of(*database, path);
    return;
  }
  const auto directory = std::filesystem::absolute(path).parent_path();
  std::error_code ignored;
  if (!std::filesystem::is_directory(directory, ignored)) {
    throw schema::UserError(
        schema::Cause::bad_input,
        path + ": there is no such directory; give a catalogue in an existing one");
  }
}

PageResponse WatchedCatalogue::page() {
  return response(page_, kShareForPages, [this](const FileMark& mark) {
    try {
      check_readable(mark);
      Json data = report_of_catalogue(call_);
      data["watch"] = {{"live", kLivePath}, {"sheet", kSheetPath}};
      return html_response(200, schema::served_page(data));
    } catch (const std::exception& error) {
      return page_about(failure_of(error).sentence(name_parameter_));
    }
  });
}

PageResponse WatchedCatalogue::live() {
  return response(live_, kShareForLive, [this](const FileMark& mark) {
    try {
      check_readable(mark);
      const auto database = schema::open_for_reading(call_.path);
      Json live = live_state_json(*database, schema::read_campaign_of(*database, call_.path));
      live["writing"] = mark.is_written();
      live["read_at_s"] = std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
      return json_response(200, live.dump(-1, ' ', false, Json::error_handler_t::replace));
    } catch (const std::exception& error) {
      return problem_response(503, failure_of(error).sentence(name_parameter_));
    }
  });
}

PageResponse WatchedCatalogue::sheet(std::uint64_t draw, const std::function<bool()>& has_gone) {
  try {
    check_readable(FileMark::of(call_.path));
    return sheets_.sheet(draw, has_gone);
  } catch (const std::exception& error) {
    return problem_response(503, failure_of(error).sentence(name_parameter_));
  }
}

void WatchedCatalogue::end() {
  has_ended_ = true;
  sheets_.end();
}

PageResponse WatchedCatalogue::response(Kept& kept, double share_of_core, const Maker& make) {
  const auto told = [&](bool also_old) {
    const std::lock_guard lock(kept.asking);
    const bool rests = also_old || Clock::now() < kept.rests_until;
    return rests ? kept.response : PageResponse();
  };
  if (PageResponse response = told(false); response.body) return response;
  std::unique_lock reading(reading_, std::try_to_lock);
  if (!reading.owns_lock()) {
    if (PageResponse response = told(!kept.waits); response.body) return response;
    if (kept.waits) {
      reading.lock();
    } else if (!reading.try_lock_for(kSoon)) {
      return problem_response(503, "the page is being made; wait for it");
    }
    if (PageResponse response = told(false); response.body) return response;
  }
  const double begin_s = core_time_s();
  const FileMark mark = FileMark::of(call_.path);
  // A fault may end without a change of the file, such as a lock.
  if (kept.response.status == 200 && kept.mark.is_like(mark)) return kept.response;
  PageResponse made = make(mark);
  const double took_s = core_time_s() - begin_s;
  const std::chrono::duration<double> rest(std::max(kLeastRest_s, took_s / share_of_core));
  const std::lock_guard lock(kept.asking);
  kept.mark = mark;
  kept.response = made;
  kept.rests_until = Clock::now() + std::chrono::duration_cast<Clock::duration>(rest);
  return made;
}

// Returns the page without a campaign: it shows the problem, and waits for its end.
PageResponse WatchedCatalogue::page_about(const std::string& problem) const {
  const Json data = {
      {"format", 1},
      {"program", {{"version", build_info().version}, {"commit", build_info().commit}}},
      {"catalogue", call_.path},
      {"watch", {{"live", kLivePath}, {"problem", problem}}}};
  return html_response(503, schema::served_page(data));
}

// Refuses files at which a reader would wait, or make the writer wait, before opening them.
void WatchedCatalogue::check_readable(const FileMark& mark) const {
  const std::string& path = call_.path;
  check_kind(path);
  check_storage(path);
  if (!mark.exists()) {
    throw schema::UserError(schema::Cause::bad_input,
                            path + ": there is no such file yet; `misalign search` with " +
                                schema::parameter("catalogue") + " makes it");
  }
  if (mark.is_written() && !has_write_ahead_log(path)) {
    throw schema::UserError(
        schema::Cause::in_use,
        path + ": is being written without a log (a search begins, or runs with " +
            schema::parameter("storage", "network") +
            ", which excludes readers); wait for its end, or watch a catalogue on a local disk");
  }
}

}  // namespace misalign::search
