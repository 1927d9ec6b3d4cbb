#include "tests/simulation/visitors.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "schema/catalogue/database.hpp"
#include "search/report/live_state.hpp"
#include "search/terminal/failure.hpp"

namespace misalign::simulation {
namespace {

// The reader of the watching page, once.
std::function<int(int)> watching(const std::string& file, const schema::Campaign& campaign) {
  return [=](int) {
    try {
      const auto database = schema::open_for_reading(file);
      search::live_state_json(*database, campaign);
      return 0;
    } catch (const std::exception& error) {
      std::fputs(search::failure_of(error).what(), stderr);
      return 1;
    }
  };
}

// A program that holds the lock of SQLite's writer, if it gets it.
std::function<int(int)> locking(const std::string& file) {
  return [file](int) {
    try {
      SQLite::Database database(file, SQLite::OPEN_READWRITE, 0);
      SQLite::Transaction held(database, SQLite::TransactionBehavior::IMMEDIATE);
      stand_still(0);
    } catch (const SQLite::Exception&) {
      stand_still(0);
    }
    return 0;
  };
}

}  // namespace

void Visitors::receive(Visit visit, Random& random) {
  const std::string& name = file_.name();
  circumstances_.was_disturbed = true;
  switch (visit) {
    case Visit::look:
      file_.look();
      return;
    case Visit::long_look:
      return begin_long_look();
    case Visit::end_long_look:
    case Visit::unlock:
      return end();
    case Visit::lock:
      return begin_lock();
    case Visit::copy:
      has_copy_ = file_.copy(happens(random, 0.5));
      return;
    case Visit::take_away:
      file_.take_away();
      circumstances_.was_taken_away = file_.is_away();
      return;
    case Visit::cut_index:
      circumstances_.lost_index = ::truncate(scene_.path(name + "-shm").c_str(), 0) == 0;
      return;
    case Visit::second_search:
      return search_too();
    case Visit::status:
      return read(program({"status", name, "--json"}));
    case Visit::query:
      return read(program({"query", name, "best", "--json"}));
    case Visit::verify:
      return read(program({"verify", name, "--sample", "0"}));
    case Visit::watch:
      return read(watching(name, scene_.told.campaign));
  }
}

void Visitors::begin_long_look() {
  if (reader_) return;
  ++scene_.tally.looks;
  reader_ = std::make_unique<Process>(scene_.disk, file_.looking([] { stand_still(0); }));
  reader_->run_on();
}

void Visitors::begin_lock() {
  if (locker_) return;
  ++scene_.tally.lock_holders;
  locker_ = std::make_unique<Process>(scene_.disk, visit(locking(file_.name())));
  locker_->run_on();
  circumstances_.was_locked = true;
}

// It is the first one where the other has not opened the file yet. (Where the file is away it would
// make another.)
void Visitors::search_too() {
  if (file_.is_away()) return;
  ++scene_.tally.second_searches;
  const auto words = scene_.told.search_words(file_.name(), share_.lo, share_.hi);
  const LifeEnd end = run_through(scene_.disk, visit(program(words)));
  if (end.code != 4 && end.code != 0) scene_.fail("a second search: " + end.err);
}

void Visitors::read(std::function<int(int)> reader) {
  ++scene_.tally.looks;
  const LifeEnd end = run_through(scene_.disk, visit(std::move(reader)));
  const bool is_good = !end.by_signal && (end.code == 0 || file_.may_say(end.err));
  if (!is_good) scene_.fail(fmt::format("a reader ends with {}: {}{}", end.code, end.err, end.out));
}

void Visitors::end() {
  locker_.reset();
  if (!reader_) return;
  while (reader_->run_on()) continue;
  file_.take_long_look(reader_->end(), circumstances_.lost_index);
  reader_.reset();
}

}  // namespace misalign::simulation
