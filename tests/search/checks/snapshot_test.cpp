// A search that commits between any two steps of a reader: each sees one moment of the catalogue.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cstring>
#include <filesystem>
#include <functional>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "search/checks/merge.hpp"
#include "search/checks/verify.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "tests/folder.hpp"

namespace misalign::search {
namespace {

// Called before every statement that a reading connection makes on one file.
struct Hook {
  std::string path;
  std::function<void()> work;
  bool busy = false;  // the work makes statements too
};
Hook hook;

int before_statement(unsigned, void* context, void*, void*) {
  auto* database = static_cast<sqlite3*>(context);
  const char* name = sqlite3_db_filename(database, "main");
  const bool is_reader = sqlite3_db_readonly(database, "main") == 1;
  if (!is_reader || hook.busy || !name || hook.path != name) return 0;
  hook.busy = true;
  hook.work();
  hook.busy = false;
  return 0;
}

int watch(sqlite3* database, char**, const sqlite3_api_routines*) {
  return sqlite3_trace_v2(database, SQLITE_TRACE_STMT, before_statement, database);
}

class SnapshotTest : public testing::Test {
 protected:
  void SetUp() override {
    writer_.emplace(path("a.db"), evaluator_.campaign(), evaluator_.mechanism());
    writer_->begin_run(run_, {{0, kDraws}, {}, 100000});
    commit();
    hook = {path("a.db"), [this] { commit(); }};
    sqlite3_auto_extension(reinterpret_cast<void (*)()>(watch));
  }
  void TearDown() override {
    sqlite3_cancel_auto_extension(reinterpret_cast<void (*)()>(watch));
    writer_.reset();
  }

  // The next few draws.
  void commit() {
    if (next_ == kDraws) return;
    writer_->commit({work_off(evaluator_, {next_, next_ + kStep})});
    next_ += kStep;
  }
  std::string path(const std::string& name) const { return folder_.file(name); }

  static constexpr std::uint64_t kDraws = 4000, kStep = 5;
  const schema::RunInfo run_{"host", "0", "none", "g++", "-O2", "golden", 1};
  DrawEvaluator evaluator_{
      schema::read_campaign(schema::Json::parse(
                                R"({"pattern": {"family": "miura", "rows": 4, "columns": 4},
              "path": {"end_deg": 30}, "accept": {"deploys_from_deg": 20}})"),
                            "test")};
  const Folder folder_{"snapshot"};
  std::optional<schema::Catalogue> writer_;
  std::uint64_t next_ = 0;
};

TEST_F(SnapshotTest, VerifySlow) {
  const auto database = schema::open_for_reading(path("a.db"));
  for (int k = 0; k < 3; ++k) {
    const std::uint64_t before = next_;
    const Verification verification = verify(*database, path("a.db"), {.sample = 5, .units = 2});
    for (const auto& finding : verification.findings) ADD_FAILURE() << finding.sentence;
    EXPECT_GE(next_, before + 10 * kStep);  // the search did write meanwhile
  }
}

TEST_F(SnapshotTest, MergeSlow) {
  for (int k = 0; k < 3; ++k) {
    const std::uint64_t before = next_;
    const MergeReport report = merge({path("all.db"), {path("a.db")}, run_, schema::Builds::same});
    for (const auto& finding : report.findings) ADD_FAILURE() << finding.sentence;
    EXPECT_GE(next_, before + 10 * kStep);
    const auto merged = schema::open_for_reading(path("all.db"));
    EXPECT_GE(schema::read_state(*merged).draws_in_ledger, before);
    std::filesystem::remove(path("all.db"));
  }
}

}  // namespace
}  // namespace misalign::search
