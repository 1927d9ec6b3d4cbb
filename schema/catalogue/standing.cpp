#include "schema/catalogue/standing.hpp"

#include "schema/catalogue/database.hpp"

namespace misalign::schema {

void Standing::add(const UnitRecord& unit) {
  draws += unit.range.size();
  accepted += unit.accepted;
  for (const Candidate& candidate : unit.candidates) {
    const double deg = candidate.metrics.deploys_from_deg;
    if (!best || deg > best->deploys_from_deg ||
        (deg == best->deploys_from_deg && candidate.draw < best->draw)) {
      best = {deg, candidate.draw};
    }
  }
}

Standing read_standing(SQLite::Database& database) {
  return reading(database, [&] {
    Standing standing;
    SQLite::Statement sums(
        database, "SELECT coalesce(sum(hi - lo), 0), coalesce(sum(accepted), 0) FROM unit");
    sums.executeStep();
    standing.draws = draw_of(sums.getColumn(0));
    standing.accepted = draw_of(sums.getColumn(1));
    SQLite::Statement best(database,
                           "SELECT deploys_from_deg, min(draw) FROM candidate WHERE "
                           "deploys_from_deg = (SELECT max(deploys_from_deg) FROM candidate) "
                           "GROUP BY deploys_from_deg");
    if (best.executeStep()) {
      standing.best = {best.getColumn(0).getDouble(), draw_of(best.getColumn(1))};
    }
    return standing;
  });
}

}  // namespace misalign::schema
