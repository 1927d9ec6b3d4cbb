#include "schema/catalogue/since.hpp"

#include <string_view>

#include "schema/catalogue/metric_table.hpp"
#include "schema/records/fault_sample.hpp"

namespace misalign::schema {
namespace {

struct LaterColumn {
  std::string_view table, column;
  int since;
  const char* stand_in;  // before that
};

// By version where older ones differ. The candidates' columns are in the table of metrics.
constexpr LaterColumn kLaterColumns[] = {
    {"run", "schema_version", 2, "1"},
    // Builds of schema 3 measured by version 2 or 3 and did not say which.
    {"run", "metrics_version", 2, "1"},
    {"run", "metrics_version", 4, "min(schema_version, 2)"},
    {"run", "commits", 3, "NULL"},
    {"run", "commit_s", 3, "NULL"},
    {"run", "longest_commit_s", 3, "NULL"},
    {"run", "tables_deg", 10, "NULL"},
    {"campaign", "goal_relative_error", 3, "NULL"},
    {"yield", "from_deg", kYieldAngleSince, kThresholdSql},
    {"fault_sample", "stands_for", kRarerSampleSince, "1024"},  // kFaultSampleEvery
};

}  // namespace

std::string column_sql(const std::string& table, const std::string& column, int schema_version) {
  for (const LaterColumn& later : kLaterColumns) {
    if (later.table == table && later.column == column && schema_version < later.since) {
      return later.stand_in;
    }
  }
  const MetricEntry* metric = table == "candidate" ? find_metric(column) : nullptr;
  if (metric && schema_version < metric->schema_since) return "NULL";
  return "\"" + column + "\"";
}

std::string later_candidate_columns_sql(int schema_version) {
  std::string columns;
  for (const MetricEntry& metric : metric_table()) {
    if (schema_version < metric.schema_since) columns += std::string(", NULL AS ") + metric.name;
  }
  return columns;
}

}  // namespace misalign::schema
