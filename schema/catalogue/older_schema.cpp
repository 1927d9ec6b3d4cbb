#include "schema/catalogue/older_schema.hpp"

#include <cassert>
#include <string>

#include "schema/catalogue/since.hpp"
#include "schema/files/carried_files.hpp"
#include "schema/records/fault_sample.hpp"

namespace misalign::schema {
namespace {

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
                  column_sql("fault_sample", "stands_for", version) +
                  " AS stands_for FROM main.fault_sample");
    database.exec(temporary_view("faults"));
  }
  if (version < kYieldSince) {  // nobody has kept any
    database.exec(
        "CREATE TEMP VIEW yield AS SELECT NULL AS draw, NULL AS amplitude_mm, NULL AS from_deg, "
        "NULL AS trials, "
        "NULL AS survivors, NULL AS undecided, NULL AS share, NULL AS share_low, "
        "NULL AS share_high, NULL AS \"commit\", NULL AS made_at WHERE 0");
    database.exec(temporary_view("common_yield"));
  }
  if (version >= kYieldSince && version < kYieldAngleSince) {
    database.exec("CREATE TEMP VIEW yield AS SELECT *, " +
                  column_sql("yield", "from_deg", version) + " AS from_deg FROM main.yield");
  }
  if (version >= kAscentSince) return;
  database.exec(
      "CREATE TEMP VIEW ascent AS SELECT NULL AS draw, NULL AS start_value, NULL AS end_value, "
      "NULL AS steps, NULL AS sheets_folded, NULL AS ended, NULL AS limited_by WHERE 0");
  if (version < kSplittingSince) {
    database.exec("CREATE TEMP VIEW sheet AS SELECT NULL AS draw, NULL AS hash WHERE 0");
  }
  if (version < kCertificateSince) {
    database.exec(
        "CREATE TEMP VIEW certificate AS SELECT NULL AS draw, NULL AS certified_deg, "
        "NULL AS asked_deg, NULL AS ended, NULL AS place, NULL AS contact, NULL AS intervals, "
        "NULL AS seconds, NULL AS hash, NULL AS proof WHERE 0");
  }
  const std::string later = later_candidate_columns_sql(version);
  std::string candidates = temporary_view("candidates");
  const std::string table = "FROM candidate;";
  candidates.replace(candidates.rfind(table), table.size(),
                     "FROM (SELECT *" + later + " FROM main.candidate) AS candidate;");
  database.exec(candidates);
  database.exec(temporary_view("ends"));
  std::string yields = temporary_view("yields");
  const std::string join = "JOIN candidate USING (draw)";
  yields.replace(yields.rfind(join), join.size(), "JOIN temp.candidates USING (draw)");
  database.exec(yields);
}

}  // namespace misalign::schema
