#include "schema/catalogue/older_schema.hpp"

#include <cassert>
#include <string>

#include "schema/catalogue/fault_sample.hpp"
#include "schema/catalogue/since.hpp"
#include "schema/files/carried_files.hpp"

namespace misalign::schema {
namespace {

struct LaterColumn {
  const char* name;
  int since;
};
constexpr LaterColumn kLaterColumns[] = {{"slope_between_min_mm_per_deg", kBetweenSamplesSince},
                                         {"bump_deg", kBetweenSamplesSince},
                                         {"miscut_margin_mm", kMiscutSince}};

// "CREATE VIEW name AS ...;" as catalogue.sql says it, for one connection.
std::string temporary_view(const std::string& name) {
  const std::string sql = carried_text("schema/catalogue.sql");
  const std::string head = "CREATE VIEW " + name + " AS";
  const std::size_t begin = sql.find(head), end = sql.find(';', begin);
  assert(begin != std::string::npos && end != std::string::npos);
  return "CREATE TEMP VIEW " + name + " AS" +
         sql.substr(begin + head.size(), end + 1 - begin - head.size());
}

}  // namespace

void show_as_of_today(SQLite::Database& database, int version) {
  if (version < kRarerSampleSince) {
    database.exec("CREATE TEMP VIEW fault_sample AS SELECT *, " +
                  std::to_string(kFaultSampleEvery) + " AS stands_for FROM main.fault_sample");
    database.exec(temporary_view("faults"));
  }
  std::string later;
  for (const LaterColumn& column : kLaterColumns) {
    if (version < column.since) later += std::string(", NULL AS ") + column.name;
  }
  if (later.empty()) return;
  // Nobody has kept any.
  database.exec(
      "CREATE TEMP VIEW yield AS SELECT NULL AS draw, NULL AS amplitude_mm, NULL AS trials, "
      "NULL AS survivors, NULL AS undecided, NULL AS share, NULL AS share_low, "
      "NULL AS share_high, NULL AS \"commit\", NULL AS made_at WHERE 0");
  database.exec(temporary_view("common_yield"));
  std::string candidates = temporary_view("candidates");
  const std::string table = "FROM candidate;";
  candidates.replace(candidates.rfind(table), table.size(),
                     "FROM (SELECT *" + later + " FROM main.candidate) AS candidate;");
  database.exec(candidates);
  std::string yields = temporary_view("yields");
  const std::string join = "JOIN candidate USING (draw)";
  yields.replace(yields.rfind(join), join.size(), "JOIN temp.candidates USING (draw)");
  database.exec(yields);
}

}  // namespace misalign::schema
