// The tables of faults and metrics against the files that know their names.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "schema/catalogue/metric_table.hpp"
#include "schema/catalogue/study_table.hpp"
#include "schema/files/carried_files.hpp"
#include "schema/files/input.hpp"
#include "schema/report/report.hpp"
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
  const std::size_t count = static_cast<std::size_t>(solver::Fault::off_shape) + 1;
  EXPECT_EQ(solver::fault_table().size(), count);
  EXPECT_EQ(faults.size(), count);
  EXPECT_EQ(names.size(), count);
  EXPECT_EQ(labels.size(), count);
}

// Up to version 1.0.0 one name stood for both that happen between samples.
TEST(FaultTable, OneOlderNameMayBeEitherOfTwo) {
  for (const solver::FaultEntry& one : solver::fault_table()) {
    for (const solver::FaultEntry& other : solver::fault_table()) {
      const auto is_between = [](const std::string& name) {
        return name.ends_with("_between_samples");
      };
      EXPECT_EQ(solver::may_be_one_fault(one.name, other.name),
                &one == &other || (is_between(one.name) && is_between(other.name)));
    }
  }
  EXPECT_FALSE(solver::may_be_one_fault("bump", "bump_between_samples"));
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
    // A stop that is asked for lies at the threshold at most: no candidate's is softer.
    const bool may_be_accepted = entry.fault != solver::Fault::inactive_diagonal &&
                                 entry.fault != solver::Fault::soft_stop &&
                                 entry.fault != solver::Fault::off_shape &&
                                 entry.fault != solver::Fault::undecided;
    if (may_be_accepted) of_candidates.insert(entry.name);
  }
  const auto allowed = [](const Json& object) {
    return object.at(Json::json_pointer("/properties/verdict/properties/first_fault/enum"))
        .get<std::set<std::string>>();
  };
  EXPECT_EQ(allowed(schema), names);
  const Json::json_pointer of_draws("/dependencies/draw");
  EXPECT_EQ(allowed(schema.at(of_draws)), of_candidates);
}

TEST(MetricTable, HasEveryNameAndLabelOnce) {
  std::set<std::string> names, labels;
  for (const schema::MetricEntry& metric : schema::metric_table()) {
    EXPECT_TRUE(names.insert(metric.name).second) << metric.name;
    EXPECT_TRUE(!metric.label || labels.insert(metric.label).second) << metric.name;
    EXPECT_EQ(schema::find_metric(metric.name), &metric);
    const schema::Allowance& allowance = metric.allowance;
    EXPECT_TRUE(metric.is_whole() || allowance.absolute + allowance.relative > 0) << metric.name;
    EXPECT_TRUE(metric.age.first <= metric.age.present &&
                metric.age.present <= solver::kMetricsVersion)
        << metric.name;
  }
  EXPECT_EQ(schema::find_metric("draw"), nullptr);
  EXPECT_EQ(schema::metric_age("draw").present, 1);
}

struct Column {
  std::string type;
  bool may_be_null;
  friend bool operator==(const Column&, const Column&) = default;
};
std::map<std::string, Column> candidate_columns(const std::string& sql) {
  SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  database.exec(sql);
  std::map<std::string, Column> columns;
  SQLite::Statement row(database,
                        "SELECT name, type, \"notnull\" FROM pragma_table_info('candidate')");
  while (row.executeStep()) {
    columns[row.getColumn(0).getString()] = {row.getColumn(1).getString(),
                                             row.getColumn(2).getInt() == 0};
  }
  for (const char* other : {"draw", "unit", "displacements_mm", "elongation"}) {
    EXPECT_EQ(columns.erase(other), 1u) << other;
  }
  return columns;
}

TEST(MetricTable, IsTheColumnsOfEverySchema) {
  std::string made = carried_text("schema/versions/7.sql");
  for (int version = kOldestSchemaVersion; version <= kSchemaVersion; ++version) {
    std::map<std::string, Column> expected;
    for (const schema::MetricEntry& metric : schema::metric_table()) {
      if (metric.schema_since > version) continue;
      const bool came_later = metric.schema_since > 1;  // null in rows from before
      expected[metric.name] = {metric.is_whole() ? "INTEGER" : "REAL",
                               metric.may_be_none() || came_later};
    }
    if (version > kOldestSchemaVersion)
      made += carried_text("schema/migrations/" + std::to_string(version) + ".sql");
    EXPECT_EQ(candidate_columns(made), expected) << version;
    if (version < kSchemaVersion) continue;
    EXPECT_EQ(candidate_columns(carried_text("schema/catalogue.sql")), expected);
  }
}

// What candidate.schema.json says of one.
Json property_of(const schema::MetricEntry& metric) {
  const std::string unit = metric.unit;
  const std::string shown = unit == "count"   ? "A count."
                            : unit == "share" ? "No unit: 0.02 is 2 %."
                            : unit.empty()    ? "No unit."
                                              : "Unit: " + unit + ".";
  Json type = metric.is_whole() ? "integer" : "number";
  if (metric.may_be_none()) type = {type, "null"};
  Json json = {{"description", metric.meaning + (" " + shown)}, {"type", type}};
  const schema::ValueRange& range = metric.range;
  const auto number = [](double value) { return Json(static_cast<int>(value)); };
  if (std::isfinite(range.least)) {
    json[range.above_least ? "exclusiveMinimum" : "minimum"] = number(range.least);
  }
  if (std::isfinite(range.most)) json["maximum"] = number(range.most);
  return json;
}

// Text and not values: so that what the test says can be put into the file as it is.
TEST(MetricTable, IsWhatAnExportSays) {
  std::string names, properties;
  for (const schema::MetricEntry& metric : schema::metric_table()) {
    const std::string name = Json(metric.name).dump();
    names += (names.empty() ? "" : ", ") + name;
    properties +=
        (properties.empty() ? "" : ",\n") + ("        " + name) + ": " + property_of(metric).dump();
  }
  const std::string section =
      "\"required\": [" + names + "],\n      \"properties\": {\n" + properties + "\n      }";
  EXPECT_NE(source_text("schema/candidate.schema.json").find(section), std::string::npos)
      << "under properties.metrics of candidate.schema.json there must be:\n"
      << section;
}

TEST(MetricTable, IsWhatThePageKnowsToWrite) {
  const std::string page = source_text("schema/report/metrics.js");
  const Json words = words_json();
  for (const Json& metric : words.at("metrics")) {
    const std::string written = metric.at("written");
    EXPECT_TRUE(std::regex_search(page, std::regex("\n  " + written + "(:|,)"))) << metric;
  }
  EXPECT_EQ(words.at("metrics").size() + 1, schema::metric_table().size()) << "all but D's sample";
  EXPECT_EQ(words.at("faults").size(), solver::fault_table().size());
}

// Each study has its four files, by its name; what the page shows of one is what SQL may call.
TEST(StudyTable, IsWhatTheTreeHas) {
  std::size_t columns = 0;
  for (const StudyEntry& study : study_table()) {
    const std::string name(study.name), noun = name == "fold" ? "folding" : name;
    for (const std::string& path :
         {"search/verbs/" + name + ".cpp", "search/sheets/" + noun + "_text.cpp",
          "schema/exchange/" + noun + "_json.cpp"}) {
      EXPECT_FALSE(source_text(path).empty()) << path;
    }
    for (const StudyColumn& column : study.columns) {
      EXPECT_EQ(study_column(column.name), &column) << "a name of one study alone";
      ++columns;
    }
  }
  const Json shown = words_json().at("columns_of_studies");
  EXPECT_EQ(shown.size(), columns);
  for (const Json& column : shown) {
    EXPECT_TRUE(study_column(column.at("name").get<std::string>())) << column;
  }
  EXPECT_FALSE(study_column("draw"));
}

}  // namespace
}  // namespace misalign::schema
