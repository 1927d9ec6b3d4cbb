// Disks that fail: never a wrong catalogue, always a sentence, and a resumed campaign ends as if
// nothing had happened.
#include <sqlite3.h>

#include <cstdlib>
#include <iostream>

#include "schema/catalogue/ledger_check.hpp"
#include "tests/schema/catalogue_fixture.hpp"
#include "tests/schema/faulty_vfs.hpp"
#include "tests/schema/files/faulty_calls.hpp"

namespace misalign::schema {
namespace {

TEST(Storage, SharedFileSystemsAreKnown) {
  // As statfs(2) lists them.
  EXPECT_EQ(file_system_of_type(0x6969).storage, Storage::network);
  EXPECT_EQ(file_system_of_type(0x6969).name, "nfs");
  EXPECT_EQ(file_system_of_type(0xFF534D42).name, "cifs");
  EXPECT_EQ(file_system_of_type(0x0BD00BD0).name, "lustre");
  EXPECT_EQ(file_system_of_type(0x47504653).storage, Storage::network);
  EXPECT_EQ(file_system_of_type(0xEF53).storage, Storage::local);
  EXPECT_EQ(file_system_of_type(0x1234).name, "0x1234");
  EXPECT_EQ(file_system_of_type(0x1234).storage, Storage::local);
  EXPECT_EQ(file_system_of("/proc/self/nothing").storage, Storage::local);
  EXPECT_GT(file_system_of(".").free_bytes, 0u);
}

class StorageTest : public CatalogueTest {
 protected:
  static constexpr std::uint64_t kUnits = 6, kUnitDraws = 300;

  UnitRecord unit_at(std::uint64_t k) const { return unit(k * kUnitDraws, (k + 1) * kUnitDraws); }

  // A run of what is missing; how many of its commits were reported as done.
  std::uint64_t run(Storage storage, std::uint64_t& committed) const {
    Catalogue catalogue(path(), campaign_, mechanism_, storage);
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, kUnits * kUnitDraws, {}});
    const auto done = catalogue.done();
    for (std::uint64_t k = 0; k < kUnits; ++k) {
      const DrawRange range = unit_at(k).range;
      if (std::find(done.begin(), done.end(), range) != done.end()) continue;
      catalogue.commit({unit_at(k)});
      ++committed;
    }
    catalogue.end_run("complete");
    return committed;
  }

  // One fault: what was reported as committed is there, the rest was not half-written, and the same
  // run again comes to the full digest.
  void survive(FaultyVfs& vfs, const DiskFault& fault, Storage storage, const std::string& full) {
    for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
      std::filesystem::remove(path() + suffix);
    }
    const std::string where = "operation " + std::to_string(static_cast<int>(fault.operation)) +
                              ", number " + std::to_string(fault.nth) +
                              (fault.lasting ? " and after" : "");
    SCOPED_TRACE(where);
    vfs.arm(fault);
    std::uint64_t committed = 0;
    const Refusal stop = refusal([&] { run(storage, committed); });
    vfs.disarm();
    if (stop.cause) {
      ++stopped_;
      EXPECT_EQ(stop.sentence.find(path()), 0u) << stop.sentence;
      EXPECT_NE(stop.sentence.find(';'), std::string::npos) << "what to do? " << stop.sentence;
    }
    if (std::filesystem::exists(path())) {
      // Opened as the next run does: a journal that was left behind is rolled back by the writer.
      { Catalogue again(path(), campaign_, mechanism_, storage); }
      for (const Finding& f : check_ledger(*open_for_reading(path()), campaign_)) {
        ADD_FAILURE() << f.sentence;
      }
      const CatalogueState found = state();
      EXPECT_GE(found.draws_in_ledger, committed * kUnitDraws);
      EXPECT_LE(found.draws_in_ledger, (committed + 1) * kUnitDraws);
      if (found.goal_end < kEndOfDraws && found.draws > 0) {
        EXPECT_EQ(found.digest, expected({{0, found.draws_in_ledger}}));
      }
    } else {
      EXPECT_EQ(committed, 0u);
    }
    run(storage, committed);
    EXPECT_EQ(state().digest, full);
  }

  int stopped_ = 0;
};

// Every n-th operation of every kind; under the sanitizers some of them.
TEST_F(StorageTest, EveryOperationMayFail) {
#ifdef __SANITIZE_ADDRESS__
  constexpr int kEach = 23;
#else
  constexpr int kEach = 1;
#endif
  const std::string full = expected({{0, kUnits * kUnitDraws}});
  FaultyVfs vfs;
  int faults = 0;
  for (const Storage storage : {Storage::local, Storage::network}) {
    for (const DiskOperation operation : kDiskOperations) {
      std::filesystem::remove(path());
      vfs.arm({operation, 0});
      std::uint64_t committed = 0;
      run(storage, committed);
      const int operations = vfs.count();
      const bool shared = operation != DiskOperation::shared_memory || storage == Storage::local;
      EXPECT_EQ(operations > 0, shared) << static_cast<int>(operation);
      for (int n = 1; n <= operations; n += kEach) {
        for (const bool lasting : {false, true}) {
          const int error = operation == DiskOperation::write && n % 2 ? SQLITE_FULL : SQLITE_IOERR;
          survive(vfs, {operation, n, lasting, error}, storage, full);
          ++faults;
        }
      }
    }
  }
  RecordProperty("faults", faults);
  RecordProperty("runs_stopped", stopped_);
  std::cout << faults << " faults, " << stopped_ << " runs stopped by them\n";
  EXPECT_GT(stopped_, faults / 4);
}

// A migration is made whole or not at all.
TEST_F(StorageTest, MigrationsMayFail) {
  const std::string old =
      std::string(MISALIGN_SOURCE_DIR) + "/tests/fixtures/catalogue-7-from-1.db";
  const Campaign campaign = read_campaign_of(*open_for_reading(old), "fixture");
  const solver::Mechanism mechanism = mechanism_of(campaign);
  const std::string digest = read_state(*open_for_reading(old)).digest;
  FaultyVfs vfs;
  const auto migrate = [&](const DiskFault& fault) {
    for (const auto& file : std::filesystem::directory_iterator(folder_.path())) {
      std::filesystem::remove(file);
    }
    std::filesystem::copy_file(old, path());
    vfs.arm(fault);
    const Refusal stop = refusal([&] { Catalogue(path(), campaign, mechanism); });
    const int count = vfs.count();
    vfs.disarm();
    if (stop.cause) {
      EXPECT_EQ(stop.sentence.find(path()), 0u) << stop.sentence;
    }
    { Catalogue again(path(), campaign, mechanism); }
    EXPECT_EQ(state().digest, digest);
    EXPECT_TRUE(check_ledger(*open_for_reading(path()), campaign).empty());
    const std::string backup = path() + ".version-7";
    EXPECT_EQ(read_state(*open_for_reading(backup)).digest, digest);
    EXPECT_EQ(open_for_reading(backup)->execAndGet("PRAGMA integrity_check").getString(), "ok");
    return count;
  };
  for (const DiskOperation operation :
       {DiskOperation::write, DiskOperation::sync, DiskOperation::open}) {
    const int operations = migrate({operation, 0});
    for (int n = 1; n <= operations; n += 5) migrate({operation, n, true});
  }
}

TEST_F(StorageTest, AFileThatIsRemovedOrReplacedStopsTheRun) {
  {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, 4096, {}});
    catalogue.commit({unit(0, 1024)});
    std::filesystem::remove(path());
    const Refusal gone = refusal([&] { catalogue.commit({unit(1024, 2048)}); });
    EXPECT_EQ(gone.cause, Cause::failure);
    EXPECT_NE(gone.sentence.find("removed or replaced"), std::string::npos) << gone.sentence;
    std::ofstream(path()) << "another file";
    EXPECT_EQ(refusal([&] { catalogue.commit({unit(1024, 2048)}); }).cause, Cause::failure);
  }
  std::filesystem::remove_all(folder_.path());
  EXPECT_EQ(refusal([&] { open(); }).cause, Cause::failure);
}

TEST_F(StorageTest, OnSharedStorageTheWriterIsAlone) {
  std::uint64_t committed = 0;
  {
    Catalogue catalogue(path(), campaign_, mechanism_, Storage::network);
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, kUnits * kUnitDraws, {}});
    catalogue.commit({unit_at(0)});
    EXPECT_FALSE(std::filesystem::exists(path() + "-wal"));
    SQLite::Database reader(path(), SQLite::OPEN_READONLY);
    EXPECT_THROW(reader.execAndGet("SELECT count(*) FROM unit"), SQLite::Exception);
  }
  EXPECT_EQ(state().draws, kUnitDraws);
  // A write-ahead log that was left behind on a local disk is taken in.
  run(Storage::network, committed);
  EXPECT_EQ(state().digest, expected({{0, kUnits * kUnitDraws}}));
}

// A disk that cannot be read is no damaged catalogue: to put a backup in its place would be wrong.
TEST_F(StorageTest, ReadErrorsAreNoDamage) {
  std::uint64_t committed = 0;
  run(Storage::local, committed);
  const auto look = [&] {
    const auto database = open_for_reading(path());
    read_state(*database);
    query_table(*database, "SELECT * FROM candidate", TableStyle::csv);
  };
  FaultyCalls calls;
  calls.arm(FaultyCalls::Kind::read, 0, 0);
  look();
  const int reads = calls.count();
  ASSERT_GT(reads, 5);
  for (const int error : {EIO, ENXIO, ESTALE}) {
    for (int nth = 1; nth <= reads; nth += 1 + nth / 10) {
      calls.arm(FaultyCalls::Kind::read, nth, error);
      const Refusal r = refusal(look);
      EXPECT_EQ(r.cause, Cause::failure) << nth << ": " << r.sentence;
      EXPECT_EQ(r.sentence.find("damaged"), std::string::npos) << nth << ": " << r.sentence;
      EXPECT_NE(r.sentence.find("see to the disk"), std::string::npos) << nth << ": " << r.sentence;
    }
  }
  calls.arm(FaultyCalls::Kind::read, 0, 0);
  look();
}

// A file system that interrupts every call for ever.
TEST_F(StorageTest, InterruptionsEnd) {
  std::uint64_t committed = 0;
  run(Storage::local, committed);
  FaultyCalls calls;
  calls.arm(FaultyCalls::Kind::read, 3, EINTR);
  EXPECT_EQ(refusal([&] { read_state(*open_for_reading(path())); }).cause, Cause::failure);
  calls.arm(FaultyCalls::Kind::write, 1, EINTR);
  const Refusal r = refusal([&] {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {});
  });
  EXPECT_EQ(r.cause, Cause::failure) << r.sentence;
  calls.arm(FaultyCalls::Kind::write, 0, 0);
  EXPECT_EQ(state().draws, kUnits * kUnitDraws);
}

// A disk that is full, and a little less so at every start.
TEST_F(StorageTest, ALittleMoreRoomEachTimeIsProgress) {
  constexpr int kUnitsHere = 40;
  FaultyVfs vfs;
  const auto go_on = [&] {
    Catalogue catalogue(path(), campaign_, mechanism_, Storage::local);
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, kUnitsHere * kUnitDraws, {}});
    const auto done = catalogue.done();
    for (int k = static_cast<int>(done.size()); k < kUnitsHere; ++k) catalogue.commit({unit_at(k)});
    catalogue.end_run("complete");
  };
  go_on();
  const std::uint64_t whole = FaultyVfs::used(folder_.path());
  const std::string digest = state().digest;
  std::filesystem::remove(path());
  { Catalogue catalogue(path(), campaign_, mechanism_, Storage::local); }
  std::uint64_t room = FaultyVfs::used(folder_.path()), starts = 0;
  // Twice the whole and a log of the least that a start needs is room enough.
  for (std::optional<Cause> cause = Cause::failure; cause && room < 2 * whole + (200 << 10);
       ++starts) {
    room += 8 << 10;
    vfs.limit_room(folder_.path(), room);
    const Refusal r = refusal(go_on);
    cause = r.cause;
    if (cause) {
      EXPECT_EQ(r.cause, Cause::failure) << r.sentence;
      EXPECT_NE(r.sentence.find("full"), std::string::npos) << r.sentence;
    }
  }
  EXPECT_EQ(state().draws, kUnitsHere * kUnitDraws) << "after " << starts << " starts";
  EXPECT_EQ(state().digest, digest);
  std::cout << starts << " starts, " << room << " bytes of room for " << whole << "\n";
}

}  // namespace
}  // namespace misalign::schema
