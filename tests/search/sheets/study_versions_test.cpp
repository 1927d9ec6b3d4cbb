// A function of sheets that gives other numbers than before has another version, so that no
// remembered number of the older one is used.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "schema/catalogue/study_table.hpp"
#include "schema/files/json_values.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/sheet_numbers.hpp"

namespace misalign::search {
namespace {

constexpr const char* kFile = MISALIGN_SOURCE_DIR "/tests/golden/study-versions.json";

// The numbers of Table 1's sheet with friction, from 90°; null where it has none.
schema::Json numbers_now() {
  schema::Design design;
  design.friction_n_mm_per_mm = 1e-4;
  const Subject subject =
      choose_sheet(MISALIGN_SOURCE_DIR "/search/patterns/table1.json", {}, design);
  WantedNumbers all;
  all.fill(true);
  const StudyNumbers found = find_numbers(subject.sheet, subject.model.design(), 90, all, false);
  schema::Json numbers;
  for (std::size_t k = 0; k < kNumberCount; ++k) {
    const std::string name(sheet_number_names()[k]);
    numbers[name] = {{"version", schema::study_column(name)->version},
                     {"value", schema::or_null(found.numbers[k])}};
  }
  return numbers;
}

TEST(StudyVersions, ChangeWithTheNumbers) {
  const schema::Json now = numbers_now();
  const schema::Json before = schema::Json::parse(std::ifstream(kFile));
  for (const auto& [name, number] : now.items()) {
    if (!before.contains(name) || before[name]["version"] != number["version"]) {
      ADD_FAILURE() << name << ": write " << number << " into " << kFile;
    } else if (before[name]["value"].is_null() || number["value"].is_null()) {
      EXPECT_EQ(before[name], number) << "raise its version in schema/catalogue/study_table.cpp";
    } else {
      const double value = before[name]["value"];
      EXPECT_NEAR(number["value"].get<double>(), value, 1e-6 * std::abs(value))
          << name << ": raise its version in schema/catalogue/study_table.cpp";
    }
  }
}

}  // namespace
}  // namespace misalign::search
