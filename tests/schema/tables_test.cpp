// The tables of faults and metrics against the files that know their names.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "schema/files/input.hpp"
#include "solver/verdict/fault.hpp"

namespace misalign::schema {
namespace {

std::string source_text(const std::string& path) {
  std::ifstream file(std::string(MISALIGN_SOURCE_DIR) + "/" + path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(FaultTable, HasEveryFaultOnce) {
  std::set<solver::Fault> faults;
  std::set<std::string> names, labels;
  for (const solver::FaultEntry& entry : solver::fault_table()) {
    faults.insert(entry.fault);
    names.insert(entry.name);
    labels.insert(entry.label);
    EXPECT_EQ(&solver::entry_of(entry.fault), &entry);
  }
  const std::size_t count = static_cast<std::size_t>(solver::Fault::undecided) + 1;
  EXPECT_EQ(solver::fault_table().size(), count);
  EXPECT_EQ(faults.size(), count);
  EXPECT_EQ(names.size(), count);
  EXPECT_EQ(labels.size(), count);
}

// "--bump-between-samples: #b8a600;" in light and in dark.
TEST(FaultTable, EachHasAColourOfItsOwnInBothThemes) {
  const std::string style = source_text("schema/report/page.css");
  std::set<std::string> colours;
  for (const solver::FaultEntry& entry : solver::fault_table()) {
    const std::string property =
        "--" + std::regex_replace(std::string(entry.name), std::regex("_"), "-");
    const std::regex definition(property + ": (#[0-9a-f]{6});");
    const std::sregex_iterator first(style.begin(), style.end(), definition), none;
    EXPECT_EQ(std::distance(first, none), 2) << entry.name;
    for (auto at = first; at != none; ++at) colours.insert((*at)[1]);
  }
  EXPECT_EQ(colours.size(), 2 * solver::fault_table().size());
}

TEST(FaultTable, IsWhatAnExportMaySay) {
  const Json schema =
      read_json_file(std::string(MISALIGN_SOURCE_DIR) + "/schema/candidate.schema.json");
  std::set<std::string> names, of_candidates;
  for (const solver::FaultEntry& entry : solver::fault_table()) {
    names.insert(entry.name);
    const bool deploys =
        entry.fault != solver::Fault::inactive_diagonal && entry.fault != solver::Fault::undecided;
    if (deploys) of_candidates.insert(entry.name);
  }
  const auto allowed = [](const Json& object) {
    return object.at(Json::json_pointer("/properties/verdict/properties/first_fault/enum"))
        .get<std::set<std::string>>();
  };
  EXPECT_EQ(allowed(schema), names);
  const Json::json_pointer of_draws("/dependencies/draw");
  EXPECT_EQ(allowed(schema.at(of_draws)), of_candidates);
}

}  // namespace
}  // namespace misalign::schema
