// Any bytes as a catalogue, given to everything that reads one, joins several or goes on writing
// one: done, or refused in a sentence. Nothing else may happen: no crash, no leak, no other
// exception, no hang; and what is joined or written on without complaint is as good as what it
// came from.
//
//   catalogue_fuzz INPUTS [SEED]
//   catalogue_fuzz --input FILE          reads one input again
//   catalogue_fuzz --corpus DIRECTORY    writes the catalogues that it starts from
#include <sqlite3.h>
#include <sys/resource.h>

#include "schema/catalogue_state.hpp"
#include "schema/ledger_check.hpp"
#include "schema/plain_export.hpp"
#include "schema/report.hpp"
#include "schema/result_table.hpp"
#include "search/choice.hpp"
#include "search/merge.hpp"
#include "search/status.hpp"
#include "search/trial.hpp"
#include "search/verify.hpp"
#include "tests/stress/mutations.hpp"

namespace misalign::stress {
namespace {

using namespace schema;
using search::Trial;

enum Outcome { unreadable, contradictory, not_joined, joined };

const RunInfo kRun{"host", "0", "none", "g++", "-O2", "golden", 1};
constexpr DrawRange kUnitToAdd{5000, 5005};

/// A directory of our own, in memory where there is one.
class Folder {
 public:
  Folder()
      : path_((std::filesystem::exists("/dev/shm") ? "/dev/shm"
                                                   : std::filesystem::temp_directory_path()) /
              ("catalogue_fuzz_" + std::to_string(::getpid()))) {
    clear();
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string file(const std::string& name) const { return path_ / name; }
  std::string file(const std::string& name, const std::string& bytes) const {
    std::ofstream(file(name), std::ios::binary) << bytes;
    return file(name);
  }
  void clear() const {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }

 private:
  const std::filesystem::path path_;
};

std::string bytes_of(const std::string& path) {
  std::stringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

/// One campaign: intact catalogues of it, of which the first is the one to join others with.
struct Subject {
  explicit Subject(Campaign campaign) : trial(std::move(campaign)) {}

  Trial trial;
  std::vector<std::string> intact = {};  // bytes
  UnitRecord unit_to_add = search::work_off(trial, kUnitToAdd);
};

// Short paths, of which a third deploys.
Campaign quick_campaign() {
  return read_campaign(
      Json::parse(R"({"name": "quick", "pattern": {"family": "miura", "rows": 4, "columns": 4},
                      "path": {"end_deg": 30}, "accept": {"deploys_from_deg": 27}})"),
      "quick");
}

// With an undecided draw: the last one accepted of each unit.
std::string new_catalogue(Trial& trial, const Folder& folder, const std::vector<DrawRange>& units) {
  const std::string path = folder.file("new.db");
  {
    Catalogue catalogue(path, trial.campaign(), trial.mechanism());
    catalogue.begin_run(kRun, {{0, 1200}, {}, 50, 0.3});
    for (const DrawRange& range : units) {
      UnitRecord unit = search::work_off(trial, range);
      const std::uint64_t draw = unit.candidates.back().draw;
      unit.candidates.pop_back();
      --unit.accepted;
      unit.undecided.push_back({draw, {7, solver::Fault::undecided, -1, solver::PathEnd::stalled}});
      catalogue.commit({unit});
    }
    catalogue.end_run("stopped");
  }
  std::string bytes = bytes_of(path);
  folder.clear();
  return bytes;
}

/// An SQLite file in memory.
class MemoryDatabase {
 public:
  explicit MemoryDatabase(const std::string& bytes)
      : database_(":memory:", SQLite::OPEN_READWRITE) {
    auto* copy = static_cast<unsigned char*>(sqlite3_malloc64(bytes.size()));
    std::memcpy(copy, bytes.data(), bytes.size());
    const auto size = static_cast<sqlite3_int64>(bytes.size());
    sqlite3_deserialize(database_.getHandle(), "main", copy, size, size,
                        SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_RESIZEABLE);
  }

  /// Whether it could be done.
  bool run(const std::string& sql) { return database_.tryExec(sql) == SQLITE_OK; }
  std::vector<std::string> texts(const std::string& sql) {
    std::vector<std::string> all;
    SQLite::Statement rows(database_, sql);
    while (rows.executeStep()) all.push_back(rows.getColumn(0).getString());
    return all;
  }
  std::string bytes() {
    sqlite3_int64 size = 0;
    unsigned char* copy = sqlite3_serialize(database_.getHandle(), "main", &size, 0);
    std::string all(reinterpret_cast<const char*>(copy), static_cast<std::size_t>(size));
    sqlite3_free(copy);
    return all;
  }

 private:
  SQLite::Database database_;
};

class Reader {
 public:
  Reader() : old_(read_campaign_of(*open_for_reading(fixture(1)), "")), new_(quick_campaign()) {
    for (const int version : {2, 1}) old_.intact.push_back(bytes_of(fixture(version)));
    new_.intact.push_back(
        new_catalogue(new_.trial, folder_, {{20, 50}, {1010, 1035}}));  // 1024 is sampled
    new_.intact.push_back(new_catalogue(new_.trial, folder_, {{0, 20}, {20, 50}, {1000, 1030}}));
    new_.intact.push_back(in_small_pages(new_.intact.back()));
  }

  std::vector<std::string> corpus() const {
    std::vector<std::string> all = old_.intact;
    all.insert(all.end(), new_.intact.begin(), new_.intact.end());
    return all;
  }

  Outcome read(const std::string& bytes) {
    folder_.clear();
    const std::string path = folder_.file("a.db", bytes);
    bool is_good = false, is_new = false;
    const bool is_read = ends([&] {
      const auto database = open_for_reading(path);
      query(*database);
      const std::string plain = folder_.file("plain.db");
      const bool is_plain = ends([&] { export_plain(*database, plain); });
      if (is_plain != std::filesystem::exists(plain)) found("a plain export by halves");
      const CatalogueState state = read_state(*database);
      search::status_json(state).dump();
      const Campaign campaign = read_campaign_of(*database, path);
      is_new = identity(campaign) == identity(new_.trial.campaign());
      const auto deploying =
          search::deploying_from(*database, state, campaign, campaign.threshold_deg);
      search::status_text(state, deploying, search::Paint(false));
      candidates_json(*database, 10).dump();
      faults_json(*database, campaign).dump();
      search::Choice choice;
      choice.diverse = 3;
      ends([&] { search::chosen_draws(*database, choice); });
      is_good = check_ledger(*database, campaign).empty();
      const search::Verification verification = search::verify(*database, path, 1);
      search::verification_text(verification);
      search::verification_json(verification).dump();
    });
    Subject& subject = is_new ? new_ : old_;
    const bool is_joined = join({path});
    join({path, folder_.file("b.db", subject.intact.front())});
    write_on(folder_.file("c.db", bytes), subject, is_good);
    if (!is_read) return unreadable;
    return !is_good ? contradictory : is_joined ? joined : not_joined;
  }

 private:
  static std::string fixture(int version) {
    return MISALIGN_SOURCE_DIR "/tests/fixtures/catalogue-" + std::to_string(version) + ".db";
  }

  // More pages, of which a row takes several.
  std::string in_small_pages(const std::string& bytes) const {
    const std::string path = folder_.file("small.db", bytes);
    SQLite::Database(path, SQLite::OPEN_READWRITE).exec("PRAGMA page_size = 512; VACUUM");
    return bytes_of(path);
  }

  // Whether it comes to its end; otherwise it must say in a sentence why not.
  template <class Work>
  static bool ends(const Work& work) {
    try {
      work();
      return true;
    } catch (const UserError& error) {
      const std::string text = error.what();
      if (error.exit_code() < 1 || error.exit_code() > 6) found("an exit code of its own: " + text);
      if (text.find(" (") == std::string::npos && text.find(": ") == std::string::npos) {
        found("no sentence: " + text);
      }
      return false;
    }
  }

  // Everything that people ask for, each on its own.
  static void query(SQLite::Database& database) {
    static const std::vector<std::string> kRelations = {
        "campaign",   "run",       "unit",       "screened",      "fault_sample",
        "undecided",  "candidate", "candidates", "displacements", "diagonals",
        "acceptance", "faults",    "gaps"};
    const auto ask = [&](const std::string& sql) {
      for (const TableStyle style : {TableStyle::aligned, TableStyle::json, TableStyle::csv}) {
        ends([&] { query_table(database, sql, style); });
      }
    };
    for (const char* name :
         {"acceptance", "best", "rejections", "robust", "simplest", "smooth", "stroke"}) {
      ask(named_query(name));
    }
    for (const std::string& relation : kRelations) ask("SELECT * FROM " + relation);
  }

  bool join(const std::vector<std::string>& inputs) {
    const std::string output = folder_.file("joined.db");
    std::filesystem::remove(output);
    bool is_joined = false;
    ends([&] {
      const auto report = search::merge({output, inputs, kRun, Builds::mixed});
      is_joined = report.findings.empty();
    });
    if (is_joined != std::filesystem::exists(output)) found("an output that should not be there");
    if (is_joined) require_good(output, "joined");
    return is_joined;
  }

  static void require_good(const std::string& path, const std::string& what) {
    const auto database = open_for_reading(path);
    const auto findings = check_ledger(*database, read_campaign_of(*database, path));
    if (!findings.empty()) found(what + ", and wrong: " + findings.front().sentence);
  }

  // A run that resumes: it settles what is undecided, adds a unit, and ends.
  static void write_on(const std::string& path, Subject& subject, bool is_good) {
    const bool is_written = ends([&] {
      Catalogue catalogue(path, subject.trial.campaign(), subject.trial.mechanism());
      catalogue.done();
      catalogue.begin_run(kRun, {{0, 6000}, {}, 100, 0.2}, Builds::mixed);
      const auto undecided = catalogue.undecided();
      if (!undecided.empty() && undecided.front() < kEndOfDraws) {
        const std::uint64_t draw = undecided.front();
        const UnitRecord decided = search::work_off(subject.trial, {draw, draw + 1});
        if (decided.undecided.empty()) catalogue.settle(decided);
      }
      catalogue.commit({subject.unit_to_add});
      catalogue.end_run("stopped");
    });
    if (is_written && is_good) require_good(path, "written on");
  }

  const Folder folder_;
  Subject old_, new_;
};

class Mutator {
 public:
  explicit Mutator(std::vector<std::string> catalogues) : catalogues_(std::move(catalogues)) {}

  std::string next(Dice& dice) const {
    std::string bytes = dice.one_of(catalogues_);
    const int kind = static_cast<int>(dice.below(10));
    if (kind >= 4) change_rows(bytes, dice);
    if (kind < 5) {
      for (std::size_t times = 1 + dice.below(4); times > 0; --times) change_pages(bytes, dice);
    }
    return bytes;
  }

 private:
  static std::size_t page_size(const std::string& bytes) {
    const auto at = [&](std::size_t k) { return static_cast<unsigned char>(bytes[k]); };
    const std::size_t size = bytes.size() < 100 ? 0 : at(16) * 256u + at(17);
    return size < 512 ? 4096 : size;
  }

  static std::uint64_t some_number(Dice& dice) {
    static constexpr std::uint64_t kOdd[] = {
        0,     1,     2,     4,     255,        256,        512,        1024,       4095,    4096,
        32767, 32768, 65535, 65536, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0xFFFFFFFE, 0xFFFFFF};
    return dice.below(2) ? dice.one_of(kOdd) : dice.below(40);
  }

  // Big-endian, as SQLite writes them.
  static void put(std::string& bytes, std::size_t at, std::size_t length, std::uint64_t number) {
    for (std::size_t k = 0; k < length && at + k < bytes.size(); ++k) {
      bytes[at + k] = static_cast<char>(number >> (8 * (length - 1 - k)));
    }
  }

  // The file's bytes, as a disk or a copy that broke off could leave them.
  static void change_pages(std::string& bytes, Dice& dice) {
    if (bytes.size() < 100) return;
    const std::size_t size = page_size(bytes), pages = bytes.size() / size;
    const auto start = [&](std::size_t page) { return page * size + (page == 0 ? 100 : 0); };
    const std::size_t page = dice.below(pages), at = dice.below(bytes.size());
    switch (dice.below(12)) {
      case 0:
        bytes[at] = static_cast<char>(dice.words()());
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << dice.below(8)));
        break;
      case 2: {
        // The file's header: 2 bytes of page size, bytes, then 4-byte numbers.
        const std::size_t field = 16 + dice.below(21);
        field < 24 ? put(bytes, field, field == 16 ? 2 : 1, some_number(dice))
                   : put(bytes, 24 + 4 * (field - 24), 4, some_number(dice));
        break;
      }
      case 3:  // a page's header: kind, first free block, cells, content, fragments, right child
        put(bytes, start(page) + dice.below(12), 1 + dice.below(4), some_number(dice));
        break;
      case 4:  // where its cells are
        put(bytes, start(page) + 8 + 2 * dice.below(30), 2,
            dice.below(2) ? dice.below(size) : some_number(dice));
        break;
      case 5: {
        const std::size_t other = dice.below(pages);
        for (std::size_t k = 0; k < size; ++k)
          std::swap(bytes[page * size + k], bytes[other * size + k]);
        break;
      }
      case 6:
        bytes.replace(page * size, size, bytes.substr(dice.below(pages) * size, size));
        break;
      case 7:
        bytes.replace(page * size, size, std::string(size, static_cast<char>(dice.below(3) - 1)));
        break;
      case 8:
        if (dice.below(4) == 0) bytes.resize(dice.below(2) ? at : page * size);
        break;
      case 9:
        put(bytes, at, 1 + dice.below(8), some_number(dice));
        break;
      case 10: {
        const std::size_t length = dice.below(64), from = dice.below(bytes.size() - length);
        bytes.replace(std::min(at, bytes.size() - length), length, bytes.substr(from, length));
        break;
      }
      default:
        change_text(bytes, dice);
    }
  }

  // A word of the schema or of a JSON text becomes another, in as many letters.
  static void change_text(std::string& bytes, Dice& dice) {
    static constexpr const char* kWords[] = {
        "INTEGER",  "TEXT",   "REAL",     "BLOB",       "STRICT",    "CREATE",    "TABLE",
        "VIEW",     "CHECK",  "NOT NULL", "draw",       "unit",      "candidate", "lo",
        "hi",       "SELECT", "FROM",     "WHERE",      "json_each", "sum(",      "count",
        "identity", "rows",   "family",   "miura",      "_deg",      "RAISE",     "WITHOUT ROWID",
        "TRIGGER",  "INDEX",  "accepted", "REFERENCES", "GENERATED", "seed",      "A1"};
    const std::string word = dice.one_of(kWords);
    const std::size_t at = bytes.find(word, dice.below(bytes.size()));
    if (at == std::string::npos) return;
    std::string other = dice.one_of(kWords);
    other.resize(word.size(), ' ');
    if (dice.below(3) == 0) other[dice.below(other.size())] = static_cast<char>(dice.words()());
    bytes.replace(at, word.size(), other);
  }

  // What the rows say, past all checks: as a program that knows no better would write them.
  static void change_rows(std::string& bytes, Dice& dice) {
    if (dice.below(3) == 0) {  // no checks and types any more, in this and the next connection
      MemoryDatabase database(bytes);
      database.run(
          "PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = replace(sql, ') STRICT', "
          "')')");
      bytes = database.bytes();
    }
    MemoryDatabase database(bytes);
    database.run(
        "PRAGMA writable_schema = ON; PRAGMA ignore_check_constraints = ON; PRAGMA foreign_keys = "
        "OFF");
    if (dice.below(2)) database.run("DROP TRIGGER unit_moves; DROP TRIGGER unit_overlaps");
    for (std::size_t times = 1 + dice.below(3); times > 0; --times) {
      database.run(some_sql(database, dice));
    }
    bytes = database.bytes();
  }

  static std::string some_value(const std::string& column, Dice& dice) {
    static constexpr const char* kValues[] = {"NULL",
                                              "0",
                                              "-1",
                                              "1",
                                              "x'00'",
                                              "''",
                                              "'a'",
                                              "9223372036854775807",
                                              "-9223372036854775808",
                                              "4611686018427387904",
                                              "1e308",
                                              "-1e308",
                                              "9e999",
                                              "0.5",
                                              "zeroblob(16)",
                                              "zeroblob(15)",
                                              "'{}'",
                                              "'[]'",
                                              "'[1,2]'",
                                              "'{\"A8\":[0.4,0.0]}'",
                                              "CAST(x'ff41fe' AS TEXT)",
                                              "char(0, 27, 65)",
                                              "zeroblob(100000)",
                                              "hex(zeroblob(50000))",
                                              "printf('%.*c', 3000, '[')",
                                              "'2'",
                                              "5000",
                                              "1024"};
    switch (dice.below(6)) {
      case 0:
        return column + " + " + std::to_string(dice.below(5)) + " - 2";
      case 1:
        return column + " + 1 << " + std::to_string(dice.below(63));
      case 2:
        return "replace(" + column + ", " + std::to_string(dice.below(10)) + ", " +
               std::to_string(dice.below(10)) + ")";
      case 3:
        return "substr(" + column + ", " + std::to_string(dice.below(9)) + ")";
      default:
        return dice.one_of(kValues);
    }
  }

  static std::string some_sql(MemoryDatabase& database, Dice& dice) {
    static constexpr const char* kTables[] = {"campaign",     "run",       "unit",     "screened",
                                              "fault_sample", "undecided", "candidate"};
    const std::string table = dice.one_of(kTables);
    const auto columns = database.texts("SELECT name FROM pragma_table_info('" + table + "')");
    const std::string column =
        columns.empty() ? "x" : "\"" + columns[dice.below(columns.size())] + "\"";
    const std::string some_rows =
        dice.below(3) == 0 ? "" : " WHERE rowid % 3 = " + std::to_string(dice.below(3));
    const std::string number = std::to_string(some_number(dice));
    switch (dice.below(10)) {
      case 0:
        return "DELETE FROM " + table + some_rows;
      case 1:
        return "CREATE TEMP TABLE one AS SELECT * FROM " + table + " LIMIT 1; UPDATE one SET " +
               column + " = " + column + " + " + number + "; INSERT OR REPLACE INTO " + table +
               " SELECT * FROM one";
      case 2: {  // a unit that adds up, whatever it claims
        const std::string more = dice.below(2) ? number : std::to_string(1ULL << dice.below(62));
        return "UPDATE unit SET hi = hi + " + more + ", rejected = rejected + " + more +
               " WHERE lo = (SELECT max(lo) FROM unit)";
      }
      case 3:
        return "UPDATE unit SET lo = lo - " + number + ", hi = hi - " + number + some_rows;
      case 4: {
        static constexpr const char* kPragmas[] = {"user_version", "application_id",
                                                   "schema_version"};
        return std::string("PRAGMA ") + dice.one_of(kPragmas) + " = " +
               std::to_string(static_cast<int>(dice.below(9)) - 3);
      }
      case 5: {
        const auto names = database.texts("SELECT name FROM sqlite_schema WHERE sql IS NOT NULL");
        if (names.empty()) return "";
        static constexpr const char* kParts[] = {" NOT NULL", "INTEGER", "draw", "unit",
                                                 "CHECK",     "hi",      "lo",   "ORDER BY lo",
                                                 "REAL",      ",",       "(",    "VIRTUAL"};
        return std::string("UPDATE sqlite_schema SET sql = replace(sql, '") + dice.one_of(kParts) +
               "', '" + dice.one_of(kParts) + "') WHERE name = '" +
               names[dice.below(names.size())] + "'";
      }
      default:
        return "UPDATE OR REPLACE " + table + " SET " + column + " = " + some_value(column, dice) +
               some_rows;
    }
  }

  const std::vector<std::string> catalogues_;
};

}  // namespace
}  // namespace misalign::stress

int main(int argc, char** argv) {
  using namespace misalign::stress;
  if (!__sanitizer_set_death_callback) {
    // What a number in a damaged file asks for is no reason to take it.
    const rlimit memory{4ULL << 30, 4ULL << 30};
    ::setrlimit(RLIMIT_AS, &memory);
  }
  Reader reader;
  const Mutator mutator(reader.corpus());
  constexpr double kSlow_s = 5, kHang_s = 120;
  return fuzz_main(argc, argv,
                   {"catalogue_fuzz",
                    {"not read", "contradictory", "good but not joined", "joined"},
                    kSlow_s,
                    kHang_s,
                    reader.corpus(),
                    [&](Dice& dice) { return mutator.next(dice); },
                    [&](const std::string& bytes) { return reader.read(bytes); }});
}
