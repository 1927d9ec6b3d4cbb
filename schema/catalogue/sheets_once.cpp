#include "schema/catalogue/sheets_once.hpp"

#include <utility>
#include <vector>

#include "schema/catalogue/certificate_table.hpp"
#include "schema/catalogue/digest.hpp"
#include "schema/catalogue/yield.hpp"

namespace misalign::schema {
namespace {

// Deletes the candidates that `statement` selects, with their yields and certificates.
void drop(SQLite::Database& database, SQLite::Statement statement) {
  struct Row {
    std::int64_t draw, unit;
    int sample;
    std::string sheet;
  };
  std::vector<Row> rows;
  while (statement.executeStep()) {
    rows.push_back({statement.getColumn(0).getInt64(), statement.getColumn(1).getInt64(),
                    statement.getColumn(2).getInt(), statement.getColumn(3).getString()});
  }
  statement.reset();
  SQLite::Statement part(database, "SELECT digest_part FROM unit WHERE lo = ?");
  SQLite::Statement update(database,
                           "UPDATE unit SET accepted = accepted - 1, rejected = rejected + 1, "
                           "digest_part = ? WHERE lo = ?");
  SQLite::Statement yields(database, "DELETE FROM yield WHERE draw = ?");
  SQLite::Statement sheet(database, "DELETE FROM sheet WHERE draw = ?");
  SQLite::Statement candidate(database, "DELETE FROM candidate WHERE draw = ?");
  for (const Row& row : rows) {
    bind_all(part, row.unit);
    if (!part.executeStep() || part.getColumn(0).getBytes() != 16) continue;  // damaged file
    CandidateSum sum =
        CandidateSum::from_bytes(static_cast<const unsigned char*>(part.getColumn(0).getBlob()));
    CandidateSum term;
    term.add(static_cast<std::uint64_t>(row.draw), row.sample, row.sheet);
    sum.subtract(term);
    execute(update, Blob(sum.bytes()), row.unit);
    for (SQLite::Statement* remove : {&yields, &sheet, &candidate}) execute(*remove, row.draw);
  }
}

void drop_repeated(SQLite::Database& database, const Campaign& campaign,
                   const solver::Mechanism& mechanism, const DrawRange& added) {
  SQLite::Statement again = bound(
      database,
      "SELECT draw, unit, deploys_from_sample, hash, least FROM sheet JOIN candidate USING (draw) "
      "JOIN (SELECT hash, min(draw) AS least FROM sheet WHERE hash IN "
      "(SELECT hash FROM sheet WHERE draw >= ? AND draw < ?) GROUP BY hash) USING (hash) "
      "WHERE draw > least",
      added.lo, added.hi);
  while (again.executeStep()) {
    const std::uint64_t draw = draw_of(again.getColumn(0)), least = draw_of(again.getColumn(4));
    hand_on_certificate(database, campaign, mechanism, draw, least);
    hand_on_yields(database, draw, least);
  }
  again.reset();
  drop(database, std::move(again));
}

}  // namespace

void keep_each_sheet_once(SQLite::Database& database, const Campaign& campaign,
                          const solver::Mechanism& mechanism, const DrawRange& added) {
  if (!campaign.search.optimisation) drop_repeated(database, campaign, mechanism, added);
  const std::optional<std::uint64_t>& most = campaign.stop.accepted;
  if (!most) return;
  SQLite::Statement beyond =
      bound(database,
            "SELECT draw, unit, deploys_from_sample, hash FROM candidate JOIN sheet USING (draw) "
            "ORDER BY draw LIMIT -1 OFFSET ?",
            *most);
  drop(database, std::move(beyond));
}

}  // namespace misalign::schema
