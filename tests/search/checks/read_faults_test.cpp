// Disks that fail while a good catalogue is read: what is said is right, or it is said that the
// disk failed; never that the catalogue is damaged, and never another digest.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "search/checks/merge.hpp"
#include "search/checks/verify.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "tests/folder.hpp"
#include "tests/schema/faulty_vfs.hpp"

namespace misalign::search {
namespace {

using schema::DiskFault;
using schema::DiskOperation;

class ReadFaults : public testing::Test {
 protected:
  void SetUp() override {
    const std::vector<std::pair<std::string, std::uint64_t>> kFiles = {{"a.db", 0}, {"b.db", 60}};
    for (const auto& [name, first] : kFiles) {
      schema::Catalogue catalogue(path(name), evaluator_.campaign(), evaluator_.mechanism());
      catalogue.begin_run(run_, {{0, 120}, {}, 10000});
      for (std::uint64_t lo = first; lo < first + 60; lo += 20) {
        catalogue.commit({work_off(evaluator_, {lo, lo + 20})});
      }
      catalogue.end_run("complete");
    }
    digest_ = digest_of("a.db");
    merge_all();
    whole_ = digest_of("all.db");
  }

  std::string path(const std::string& name) const { return folder_.file(name); }
  std::string digest_of(const std::string& name) const {
    return schema::read_state(*schema::open_for_reading(path(name))).digest;
  }
  void verify_a() const {
    const auto database = schema::open_for_reading(path("a.db"));
    const Verification v = verify(*database, path("a.db"), {.sample = 1});
    for (const auto& finding : v.findings) ADD_FAILURE() << finding.sentence;
    EXPECT_EQ(v.digest, digest_);
  }
  void merge_all() const {
    // A whole one may still be in WAL mode, if the disk failed as that was to end: then whoever
    // reads it makes a log.
    for (const char* suffix : {"", "-wal", "-shm"}) {
      std::filesystem::remove(path("all.db") + suffix);
    }
    const MergeReport report =
        merge({path("all.db"), {path("a.db"), path("b.db")}, run_, schema::Builds::same});
    for (const auto& finding : report.findings) ADD_FAILURE() << finding.sentence;
  }

  void expect_whole_or_none() const {
    if (!std::filesystem::exists(path("all.db"))) return;
    try {
      EXPECT_EQ(digest_of("all.db"), whole_);
    } catch (const schema::UserError& error) {
      ADD_FAILURE() << error.what();
    }
  }

  // Every n-th operation of a kind; how many were tried, and how many ended the work.
  void inject(const std::function<void()>& work, DiskOperation operation, int error) {
    // A part of them; all by MISALIGN_ALL_FAULTS=1.
    const int each = std::getenv("MISALIGN_ALL_FAULTS") ? 1 : 9;
    vfs_.arm({operation, 0});
    work();
    const int operations = vfs_.count();
    for (int n = 1; n <= operations; n += each) {
      for (const bool lasting : {false, true}) {
        SCOPED_TRACE("operation " + std::to_string(static_cast<int>(operation)) + ", number " +
                     std::to_string(n) + (lasting ? " and after" : ""));
        vfs_.arm({operation, n, lasting, error});
        try {
          work();
        } catch (const schema::UserError& stop) {
          ++stopped_;
          const std::string sentence = stop.what();
          EXPECT_TRUE(stop.cause() == schema::Cause::failure ||
                      stop.cause() == schema::Cause::in_use)
              << sentence;
          EXPECT_EQ(sentence.find(folder_.path()), 0u) << sentence;
          EXPECT_EQ(sentence.find("damaged"), std::string::npos) << sentence;
        }
        vfs_.disarm();
        ++faults_;
        EXPECT_EQ(digest_of("a.db"), digest_);
        expect_whole_or_none();
      }
    }
  }

  const schema::RunInfo run_{"host", "0", "none", "g++", "-O2", "golden", 1};
  DrawEvaluator evaluator_{
      schema::read_campaign(schema::Json::parse(
                                R"({"pattern": {"family": "miura", "rows": 4, "columns": 4},
              "path": {"end_deg": 30}, "accept": {"deploys_from_deg": 20}})"),
                            "test")};
  schema::FaultyVfs vfs_;
  const Folder folder_{"read_faults"};
  std::string digest_, whole_;
  int faults_ = 0, stopped_ = 0;
};

TEST_F(ReadFaults, NeverCalledDamage) {
  for (const DiskOperation operation :
       {DiskOperation::open, DiskOperation::read, DiskOperation::lock, DiskOperation::file_size}) {
    const int error = operation == DiskOperation::read ? SQLITE_IOERR_READ : SQLITE_IOERR;
    inject([&] { EXPECT_EQ(digest_of("a.db"), digest_); }, operation, error);
    inject([&] { verify_a(); }, operation, error);
    inject([&] { merge_all(); }, operation, error);
  }
  inject([&] { merge_all(); }, DiskOperation::write, SQLITE_FULL);
  inject([&] { merge_all(); }, DiskOperation::sync, SQLITE_IOERR);
  std::cout << faults_ << " faults, " << stopped_ << " runs stopped by them\n";
  EXPECT_GT(stopped_, faults_ / 3);
}

}  // namespace
}  // namespace misalign::search
