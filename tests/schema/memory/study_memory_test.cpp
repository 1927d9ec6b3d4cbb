// Numbers of studies are found again as they were kept, and for nothing else.
#include "schema/memory/study_memory.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "schema/campaign/campaign_file.hpp"
#include "tests/folder.hpp"

namespace misalign::schema {
namespace {

class StudyMemoryTest : public testing::Test {
 protected:
  static StudyNumber number(std::optional<double> value = {}) {
    return {"energy_n_mm", 90, 17, sheet_key(Eigen::Matrix2Xd::Ones(2, 3)), value};
  }
  std::string file() const { return StudyMemory::path_beside(catalogue_); }
  bool is_found(StudyNumber wanted, const Campaign& campaign = default_campaign()) const {
    return StudyMemory(catalogue_, campaign).find(wanted);
  }
  void change(const std::string& sql) const {
    SQLite::Database(file(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE).exec(sql);
  }

  const Folder folder_{"study_memory"};
  const std::string catalogue_ = folder_.file("a.db");
};

TEST_F(StudyMemoryTest, FindsWhatWasKept) {
  StudyMemory memory(catalogue_, default_campaign());
  StudyNumber wanted = number();
  EXPECT_FALSE(memory.find(wanted));
  EXPECT_FALSE(std::filesystem::exists(file())) << "nothing is written before there is a number";
  StudyNumber none = number();
  none.draw = 18;
  memory.keep({number(0.1), none});
  StudyMemory other(catalogue_, default_campaign());
  EXPECT_TRUE(other.find(wanted));
  EXPECT_EQ(wanted.value, 0.1);
  none.value = 1;
  EXPECT_TRUE(other.find(none));
  EXPECT_FALSE(none.value) << "that a study has no number is kept, too";
  memory.keep({number(0.2)});
  EXPECT_TRUE(other.find(wanted));
  EXPECT_EQ(wanted.value, 0.2);
  EXPECT_EQ(other.all().size(), 2);
  EXPECT_EQ(other.all()[0].from_deg, 90);
}

TEST_F(StudyMemoryTest, FindsNothingOfAnotherSheetDesignOrVersion) {
  StudyMemory(catalogue_, default_campaign()).keep({number(0.1)});
  ASSERT_TRUE(is_found(number()));
  StudyNumber other = number();
  other.sheet = sheet_key(Eigen::Matrix2Xd::Zero(2, 3));
  EXPECT_FALSE(is_found(other));
  other = number();
  other.from_deg.reset();
  EXPECT_FALSE(is_found(other));
  other = number();
  other.function = "thickness_mm";
  EXPECT_FALSE(is_found(other));
  Campaign designed = default_campaign();
  designed.design.stiffness_n_per_mm = 2;
  EXPECT_FALSE(is_found(number(), designed));
  EXPECT_EQ(StudyMemory(catalogue_, designed).stale(), 1);
  change("UPDATE number SET version = version + 1");
  EXPECT_FALSE(is_found(number()));
  EXPECT_EQ(StudyMemory(catalogue_, default_campaign()).stale(), 1);
}

// Statements of a foreign file must not run, nor may its faults end a query.
TEST_F(StudyMemoryTest, LeavesForeignAndDamagedFilesAlone) {
  const auto is_refused = [&] {
    StudyMemory memory(catalogue_, default_campaign());
    memory.keep({number(0.1)});
    StudyNumber wanted = number();
    return !memory.find(wanted) && memory.fault().find(file()) != std::string::npos;
  };
  change("CREATE TABLE number (function TEXT, other TEXT)");
  EXPECT_TRUE(is_refused());
  std::filesystem::remove(file());
  StudyMemory(catalogue_, default_campaign()).keep({number(0.1)});
  change("CREATE TRIGGER mine AFTER INSERT ON number BEGIN DELETE FROM number; END");
  EXPECT_TRUE(is_refused());
  std::ofstream(file()) << std::string(4096, 'x');
  EXPECT_TRUE(is_refused());
  std::filesystem::remove(file());
  std::filesystem::create_directory(file());
  EXPECT_TRUE(is_refused());
}

TEST_F(StudyMemoryTest, KeepsNothingWithoutACatalogue) {
  StudyMemory memory("", default_campaign());
  memory.keep({number(0.1)});
  StudyNumber wanted = number();
  EXPECT_FALSE(memory.find(wanted));
  EXPECT_TRUE(memory.fault().empty());
}

}  // namespace
}  // namespace misalign::schema
