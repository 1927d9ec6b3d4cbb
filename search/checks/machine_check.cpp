#include "search/checks/machine_check.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "schema/catalogue/database.hpp"
#include "schema/catalogue/writer_lock.hpp"
#include "schema/files/features.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/draws/golden_verdicts.hpp"
#include "search/terminal/stopwatch.hpp"

namespace misalign::search {
namespace {

using schema::Json;

const char* name_of(Health health) {
  switch (health) {
    case Health::good:
      return "good";
    case Health::note:
      return "note";
    case Health::bad:
      return "BAD";
  }
  return "";
}

// Measures small transactions, like those of a catalogue.
double commits_per_s(const std::string& path, schema::Storage storage) {
  constexpr int kCommits = 50;
  const auto database = schema::open_for_writing(path, storage);
  database->exec(storage == schema::Storage::local ? "PRAGMA journal_mode = WAL"
                                                   : "PRAGMA journal_mode = TRUNCATE");
  database->exec("CREATE TABLE t (x)");
  const Stopwatch watch;
  for (int k = 0; k < kCommits; ++k) database->exec("INSERT INTO t VALUES (randomblob(100))");
  return kCommits / watch.seconds();
}

std::string whole(double number) { return std::to_string(static_cast<long long>(number)); }

}  // namespace

std::string pack(const RankReport& report) {
  return report.golden_verdicts + " " + std::to_string(report.threads) + " " + report.host;
}

RankReport unpack_rank(const std::string& text) {
  const auto first = text.find(' '), second = text.find(' ', first + 1);
  return {text.substr(second + 1), std::stoi(text.substr(first + 1, second - first - 1)),
          text.substr(0, first)};
}

std::vector<Check> check_numbers() {
  std::vector<Check> checks;
  checks.push_back(random_numbers_as_published()
                       ? Check{"random numbers", Health::good, "as published"}
                       : Check{"random numbers", Health::bad,
                               "not as published: this build is broken; build it again"});
  std::map<std::string, std::vector<std::string>> sets_of;  // instruction sets by their verdicts
  std::string widest;
  for (const auto set : solver::available_instruction_sets()) {
    widest = solver::instruction_set_name(set);
    sets_of[golden_verdicts(set)].push_back(widest);
  }
  checks.push_back(
      {"instruction set", widest == "baseline" ? Health::note : Health::good,
       widest == "baseline" ? "baseline: four sheets at a time instead of 8 or 16" : widest});
  if (sets_of.size() == 1) {
    const auto& [verdicts, sets] = *sets_of.begin();
    checks.push_back({"golden verdicts", Health::good,
                      fmt::format("{} by {}", verdicts.substr(0, 8), fmt::join(sets, ", "))});
  } else {
    std::vector<std::string> groups;
    for (const auto& [verdicts, sets] : sets_of) {
      groups.push_back(fmt::to_string(fmt::join(sets, ", ")));
    }
    checks.push_back({"golden verdicts", Health::bad,
                      fmt::format("differ between {}: this build or this machine is broken; build "
                                  "again and run the tests",
                                  fmt::join(groups, " | "))});
  }
  return checks;
}

Check check_libraries() {
  std::vector<std::string> missing;
  for (const Feature& feature : kFeatures) {
    if (!feature.is_in) missing.push_back(fmt::format("{} ({})", feature.library, feature.purpose));
  }
  const std::string in = "with " + schema::libraries_text(true);
  if (missing.empty()) return {"libraries", Health::good, in};
  return {"libraries", Health::note, fmt::format("{}; without {}", in, fmt::join(missing, ", "))};
}

std::vector<Check> check_directory(const std::string& directory) {
  namespace fs = std::filesystem;
  const std::string path =
      (fs::path(directory) / (".misalign-doctor-" + std::to_string(::getpid()))).string();
  if (!fs::is_directory(directory)) {
    return {
        {"directory", Health::bad, directory + ": is no directory; create it, or give another"}};
  }
  const schema::FileSystem system = schema::file_system_of(path);
  const bool shared = system.storage == schema::Storage::network;
  std::vector<Check> checks;
  checks.push_back(
      {"file system", shared ? Health::note : Health::good,
       system.name + (shared ? ", shared by machines: a rollback journal and an exclusive lock are "
                               "used; put catalogues on a local disk if readers should not wait"
                             : ", local: a write-ahead log is used, readers never wait")});
  constexpr std::uint64_t kLittle_bytes = 1ULL << 30;
  const std::string free = whole(static_cast<double>(system.free_bytes) / 1e6) + " MB";
  checks.push_back(system.free_bytes > kLittle_bytes
                       ? Check{"free space", Health::good, free}
                       : Check{"free space", Health::note,
                               free + ": a million candidates need 1 to 2 GB; free some space"});
  try {
    const schema::WriterLock lock(path);
    const double speed = schema::guarded(path, [&] { return commits_per_s(path, system.storage); });
    constexpr double kSlow = 20;
    checks.push_back(
        {"commits", speed < kSlow ? Health::note : Health::good,
         whole(speed) + " per second" +
             (speed < kSlow ? ": this disk is slow; use a faster one for many ranks" : "")});
  } catch (const schema::UserError& error) {
    checks.push_back({"commits", Health::bad, error.what()});
  }
  std::error_code ignored;
  for (const char* suffix : {"", "-journal", "-wal", "-shm"}) fs::remove(path + suffix, ignored);
  return checks;
}

std::vector<Check> check_ranks(const std::vector<RankReport>& ranks, bool has_beats) {
  std::map<std::string, std::pair<int, int>> hosts;  // ranks, threads
  std::set<std::string> verdicts;
  for (const RankReport& rank : ranks) {
    ++hosts[rank.host].first;
    hosts[rank.host].second = rank.threads;
    verdicts.insert(rank.golden_verdicts);
  }
  std::vector<std::string> each;
  std::string crowded, idle;
  for (const auto& [host, count] : hosts) {
    const auto [on_it, threads] = count;
    each.push_back(fmt::format("{} on {} ({} threads)", on_it, host, threads));
    if (on_it > threads) crowded += " " + host;
    if (on_it < threads) idle += " " + host;
  }
  const std::string all = fmt::to_string(fmt::join(each, ", "));
  std::vector<Check> checks;
  if (!crowded.empty()) {
    checks.push_back({"ranks", Health::note,
                      all + ": more ranks than threads on" + crowded +
                          "; start fewer ranks, or omit --bind-to"});
  } else if (!idle.empty()) {
    checks.push_back(
        {"ranks", Health::note,
         all + ": idle threads on" + idle + "; search --ranks all, or mpirun -n, uses more"});
  } else {
    checks.push_back({"ranks", Health::good, all});
  }
  if (ranks.size() > 1) {
    checks.push_back(
        has_beats
            ? Check{"heartbeat", Health::good, "MPI allows threads"}
            : Check{
                  "heartbeat", Health::note,
                  "this MPI allows no threads: a cut link is noticed by MPI alone, minutes later"});
    checks.push_back(verdicts.size() == 1
                         ? Check{"same verdicts", Health::good, "on every rank"}
                         : Check{"same verdicts", Health::bad,
                                 "not on every rank: install the same build on every host"});
  }
  return checks;
}

std::string checks_text(const std::vector<Check>& checks) {
  std::string text;
  for (const Check& check : checks) {
    text += fmt::format("{:<6}{:<17}{}\n", name_of(check.health), check.name,
                        schema::printable(check.sentence));
  }
  return text;
}

Json checks_json(const std::vector<Check>& checks) {
  Json list = Json::array();
  for (const Check& check : checks) {
    list.push_back(
        {{"check", check.name}, {"health", name_of(check.health)}, {"sentence", check.sentence}});
  }
  return {{"good", !any_bad(checks)}, {"checks", list}};
}

bool any_bad(const std::vector<Check>& checks) {
  return std::any_of(checks.begin(), checks.end(),
                     [](const Check& check) { return check.health == Health::bad; });
}

}  // namespace misalign::search
