// Disks that fail while a splitting search climbs, or certificates are kept: a sentence each time,
// and the same work once more comes to what an undisturbed one gives.
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <iostream>

#include "schema/catalogue/ledger_check.hpp"
#include "search/draws/models.hpp"
#include "search/sheets/campaign_sheet.hpp"
#include "search/sheets/row_certifier.hpp"
#include "tests/folder.hpp"
#include "tests/schema/catalogue_fixture.hpp"
#include "tests/schema/faulty_vfs.hpp"
#include "tests/search/climb_on.hpp"

namespace misalign::search {
namespace {

using schema::DiskFault;
using schema::DiskOperation;

class WriteFaults : public testing::Test {
 protected:
  // All that is in these tables but the times that it took.
  std::string rows() const {
    const auto database = schema::open_for_reading(path_);
    std::string all = schema::read_state(*database).digest + "\n";
    for (const char* sql :
         {"SELECT unit, level, particles, survivors, ancestors, tried, taken, undecided, met FROM "
          "population",
          "SELECT number, score FROM level", "SELECT draw, hex(hash) FROM sheet ORDER BY draw",
          "SELECT count(*) FROM piece",
          "SELECT draw, certified_deg, ended, hash, hex(proof) FROM certificate ORDER BY draw"}) {
      all += schema::query_table(*database, sql, schema::TableStyle::csv);
    }
    return all;
  }

  void begin_anew() const {
    for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
      std::filesystem::remove(path_ + suffix);
    }
    if (!begun_from_.empty()) std::filesystem::copy_file(begun_from_, path_);
  }

  // A part of the faults; all by MISALIGN_ALL_FAULTS=1.
  void survive_all(const schema::Campaign& campaign, const std::function<void()>& work) {
    const int each = std::getenv("MISALIGN_ALL_FAULTS") ? 1 : 47;
    begin_anew();
    work();
    const std::string undisturbed = rows();
    schema::FaultyVfs vfs;
    for (const DiskOperation operation : schema::kDiskOperations) {
      begin_anew();
      vfs.arm({operation, 0});
      work();
      const int operations = vfs.count();
      for (int n = 1; n <= operations; n += each) {
        for (const bool lasting : {false, true}) {
          begin_anew();
          const int error = operation == DiskOperation::write && n % 2 ? SQLITE_FULL : SQLITE_IOERR;
          survive(vfs, {operation, n, lasting, error}, work);
          vfs.disarm();
          work();
          ASSERT_EQ(rows(), undisturbed);
          for (const auto& f : schema::check_ledger(*schema::open_for_reading(path_), campaign)) {
            ADD_FAILURE() << f.sentence;
          }
        }
      }
    }
    std::cout << faults_ << " faults, " << stopped_ << " runs stopped by them\n";
    EXPECT_GT(stopped_, faults_ / 4);
  }

  void survive(schema::FaultyVfs& vfs, const DiskFault& fault, const std::function<void()>& work) {
    SCOPED_TRACE("operation " + std::to_string(static_cast<int>(fault.operation)) + ", number " +
                 std::to_string(fault.nth) + (fault.lasting ? " and after" : ""));
    ++faults_;
    vfs.arm(fault);
    try {
      work();
    } catch (const schema::UserError& stop) {
      ++stopped_;
      const std::string sentence = stop.what();
      EXPECT_EQ(sentence.find(path_), 0u) << sentence;
      EXPECT_NE(sentence.find(';'), std::string::npos) << "what to do? " << sentence;
    }
  }

  const Folder folder_{"write_faults"};
  const std::string path_ = folder_.file("a.db");
  std::string begun_from_;  // empty: from nothing
  int faults_ = 0, stopped_ = 0;
};

TEST_F(WriteFaults, OfASplittingSearch) {
  const schema::Campaign campaign = quick_climb();
  Climber climber(campaign, widest_set());
  survive_all(campaign, [&] {  // three runs: pieces are kept, taken up, and become populations
    for (const int blocks : {4, 5, 1000}) {
      climb_on(path_, climber, schema::kRun, 2, blocks);
    }
  });
}

TEST_F(WriteFaults, OfCertificates) {
  const schema::Campaign campaign = quick_climb();
  Climber climber(campaign, widest_set());
  begun_from_ = folder_.file("found.db");
  climb_on(begun_from_, climber, schema::kRun, 1, 1000);
  const solver::Model model = model_of(campaign);
  RowCertifier certifier(campaign.pattern, model);
  std::vector<schema::CertificateRecord> made;
  {
    const auto database = schema::open_for_reading(begun_from_);
    const auto draws = schema::draws_of(*database, "candidate", {0, schema::kEndOfDraws});
    for (std::size_t k = 0; k < 6; ++k) {
      made.push_back(
          certifier.certify(draws[k], shifts_of_number(*database, campaign, draws[k]), 20));
    }
  }
  survive_all(campaign, [&] {
    schema::Catalogue catalogue(path_, campaign, climber.mechanism(), {}, schema::Missing::refused);
    for (const schema::CertificateRecord& row : made) catalogue.keep({row});
    catalogue.close();
  });
}

}  // namespace
}  // namespace misalign::search
