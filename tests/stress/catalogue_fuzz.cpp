// Any bytes as a catalogue, given to everything that reads one, joins several or goes on writing
// one: done, or refused in a sentence. Nothing else may happen: no crash, no leak, no other
// exception, no hang; and what is joined or written on without complaint is as good as what it
// came from.
//
//   catalogue_fuzz INPUTS [SEED]
//   catalogue_fuzz --input FILE          reads one input again
//   catalogue_fuzz --corpus DIRECTORY    writes the catalogues that it starts from
#include <sys/resource.h>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/certificate_table.hpp"
#include "schema/catalogue/ledger_check.hpp"
#include "schema/catalogue/named_queries.hpp"
#include "schema/catalogue/result_table.hpp"
#include "schema/report/report.hpp"
#include "search/checks/merge.hpp"
#include "search/checks/verification_text.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/sheets/choice.hpp"
#include "search/terminal/ladder_text.hpp"
#include "search/terminal/status_text.hpp"
#include "solver/certificate/certifier.hpp"
#include "tests/folder.hpp"
#include "tests/search/climb_on.hpp"
#include "tests/stress/catalogue_mutations.hpp"

namespace misalign::stress {
namespace {

using namespace schema;
using search::DrawEvaluator;

enum Outcome { unreadable, contradictory, not_joined, joined };

const RunInfo kRun{"host", "0", "none", "g++", "-O2", "golden", 1};
constexpr DrawRange kUnitToAdd{5000, 5005};
constexpr int kMostBlocks = 1000;  // of a climb: many more than there are

/// One campaign: intact catalogues of it, of which the first is the one to join others with.
struct Subject {
  explicit Subject(Campaign campaign) : evaluator(std::move(campaign)) {}

  DrawEvaluator evaluator;
  std::vector<std::string> intact = {};  // bytes
  UnitRecord unit_to_add = search::work_off(evaluator, kUnitToAdd);
  bool is_of(const Campaign& campaign) const {
    return identity(campaign) == identity(evaluator.campaign());
  }
};

// Short paths, of which a third deploys.
Campaign quick_campaign() {
  return read_campaign(
      Json::parse(R"({"name": "quick", "pattern": {"family": "miura", "rows": 4, "columns": 4},
                      "path": {"end_deg": 30}, "accept": {"deploys_from_deg": 27}})"),
      "quick");
}

// Of every other candidate: that it deploys up to its D.
void keep_certificates(Catalogue& catalogue, const DrawEvaluator& evaluator,
                       const std::vector<Candidate>& candidates) {
  const Campaign& campaign = evaluator.campaign();
  const solver::Model model(campaign.pattern.base, campaign.path());
  solver::Certifier certifier(model);
  std::vector<CertificateRecord> rows;
  for (std::size_t k = 0; k < candidates.size(); k += 2) {
    const Candidate& candidate = candidates[k];
    const solver::Certificate made =
        certifier.certify(campaign.pattern.base.sheet.vertices_mm + candidate.shifts_mm,
                          candidate.metrics.deploys_from_deg);
    rows.push_back(certificate_row(campaign.pattern, evaluator.mechanism(), candidate.draw,
                                   candidate.shifts_mm, made, 0.5));
  }
  catalogue.keep(rows);
}

// With an undecided draw: the last one accepted of each unit.
std::string new_catalogue(DrawEvaluator& evaluator, const Folder& folder,
                          const std::vector<DrawRange>& units) {
  const std::string path = folder.file("new.db");
  {
    Catalogue catalogue(path, evaluator.campaign(), evaluator.mechanism());
    catalogue.begin_run(kRun, {{0, 1200}, {}, 50, 0.3});
    for (const DrawRange& range : units) {
      UnitRecord unit = search::work_off(evaluator, range);
      const std::uint64_t draw = unit.candidates.back().draw;
      unit.candidates.pop_back();
      --unit.accepted;
      unit.undecided.push_back({draw, {7, solver::Fault::undecided, -1, solver::PathEnd::stalled}});
      catalogue.commit({unit});
      keep_certificates(catalogue, evaluator, unit.candidates);
    }
    catalogue.end_run("stopped");
  }
  std::string bytes = bytes_of(path);
  folder.clear();
  return bytes;
}

// Of a splitting search: so many blocks of three populations, of five each.
std::string new_climb(search::Climber& climber, const Folder& folder, int blocks) {
  const std::string path = folder.file("new.db");
  search::climb_on(path, climber, kRun, 3, blocks);
  std::string bytes = bytes_of(path);
  folder.clear();
  return bytes;
}

class Reader {
 public:
  Reader() : old_(read_campaign_of(*open_for_reading(fixture(1)), "")), new_(quick_campaign()) {
    for (const int version : {3, 2, 1}) old_.intact.push_back(bytes_of(fixture(version)));
    new_.intact.push_back(
        new_catalogue(new_.evaluator, folder_, {{20, 50}, {1010, 1035}}));  // 1024 is sampled
    new_.intact.push_back(
        new_catalogue(new_.evaluator, folder_, {{0, 20}, {20, 50}, {1000, 1030}}));
    new_.intact.push_back(in_small_pages(new_.intact.back()));
    for (const int blocks : {5, 13}) {
      split_.intact.push_back(new_climb(climber_, folder_, blocks));
    }
  }

  std::vector<std::string> corpus() const {
    std::vector<std::string> all = old_.intact;
    for (const Subject* subject : {&new_, &split_}) {
      all.insert(all.end(), subject->intact.begin(), subject->intact.end());
    }
    return all;
  }

  Outcome read(const std::string& bytes) {
    folder_.clear();
    const std::string path = folder_.file("a.db", bytes);
    bool is_good = false;
    Subject* subject = &old_;
    const bool is_read = ends([&] {
      const auto database = open_for_reading(path);
      query(*database);
      const CatalogueState state = read_state(*database);
      status_json(state).dump();
      if (state.ladder && !state.ladder->levels.empty()) {
        const std::string sql = ladder_sql(*state.ladder);
        check_shown(query_table(*database, sql, TableStyle::aligned), std::string::npos);
      }
      const Campaign campaign = read_campaign_of(*database, path);
      for (Subject* one : {&new_, &split_}) {
        if (one->is_of(campaign)) subject = one;
      }
      const auto deploying =
          search::deploying_from(*database, state, campaign, campaign.threshold_deg);
      check_shown(search::status_text(state, deploying, search::Paint(false)));
      candidates_json(*database, 10).dump();
      report_certificates_json(*database, 10, {20}).dump();
      faults_json(*database, campaign).dump();
      search::Choice choice;
      choice.diverse = 3;
      ends([&] { search::chosen_draws(*database, choice); });
      is_good = check_ledger(*database, campaign).empty();
      const search::Verification verification = search::verify(*database, path, {.sample = 1});
      check_shown(search::verification_text(verification));
      search::verification_json(verification).dump();
    });
    const bool is_joined = join({path});
    join({path, folder_.file("b.db", subject->intact.front())});
    write_on(folder_.file("c.db", bytes), *subject, is_good);
    if (!is_read) return unreadable;
    return !is_good ? contradictory : is_joined ? joined : not_joined;
  }

 private:
  static std::string fixture(int version) {
    return MISALIGN_SOURCE_DIR "/tests/fixtures/catalogue-7-from-" + std::to_string(version) +
           ".db";
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
      check_shown(text);
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
        "acceptance", "faults",    "gaps",       "level",         "population",
        "sheet",      "piece",     "ladder",     "certificate"};
    const auto ask = [&](const std::string& sql) {
      for (const TableStyle style : {TableStyle::aligned, TableStyle::json, TableStyle::csv}) {
        ends([&] {
          const std::string rows = query_table(database, sql, style);
          if (style == TableStyle::aligned) check_shown(rows, std::string::npos);
        });
      }
    };
    for (const std::string& name : named_queries()) ask(named_query(name));
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
    if (is_joined) {
      require_good(output, "joined");
      const auto database = open_for_reading(output);
      const auto checked = check_certificates(*database, read_campaign_of(*database, output));
      if (!checked.findings.empty()) found("joined: " + checked.findings.front().sentence);
    }
    return is_joined;
  }

  static void require_good(const std::string& path, const std::string& what) {
    const auto database = open_for_reading(path);
    const auto findings = check_ledger(*database, read_campaign_of(*database, path));
    if (!findings.empty()) found(what + ", and wrong: " + findings.front().sentence);
  }

  // A run that resumes: it settles what is undecided, adds a unit, and ends.
  void write_on(const std::string& path, Subject& subject, bool is_good) {
    const bool is_written = ends([&] {
      if (&subject == &split_) {
        search::climb_on(path, climber_, kRun, 3, kMostBlocks);
        return;
      }
      Catalogue catalogue(path, subject.evaluator.campaign(), subject.evaluator.mechanism());
      catalogue.done();
      catalogue.begin_run(kRun, {{0, 6000}, {}, 100, 0.2}, Builds::mixed);
      const auto undecided = catalogue.undecided();
      if (!undecided.empty() && undecided.front() < kEndOfDraws) {
        const std::uint64_t draw = undecided.front();
        const UnitRecord decided = search::work_off(subject.evaluator, {draw, draw + 1});
        if (decided.undecided.empty()) catalogue.settle(decided);
      }
      catalogue.commit({subject.unit_to_add});
      catalogue.end_run("stopped");
    });
    if (is_written && is_good) require_good(path, "written on");
  }

  const Folder folder_{"catalogue_fuzz"};
  Subject old_, new_, split_{search::quick_climb()};
  search::Climber climber_{split_.evaluator.campaign(), search::widest_set()};
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
  const CatalogueMutator mutator(reader.corpus());
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
