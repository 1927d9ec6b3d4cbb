#include "schema/catalogue/yield.hpp"

#include <cmath>

#include "schema/campaign/share_interval.hpp"
#include "schema/catalogue/population_rows.hpp"
#include "schema/files/json_values.hpp"

namespace misalign::schema {
namespace {

// SQL of the campaign's threshold.
constexpr const char* kThresholdSql =
    "(SELECT json_extract(configuration, '$.accept.deploys_from_deg') FROM campaign)";

// Inserts a yield; ignores draws that are no candidates, and replaces a stored yield only by one
// with more trials.
const std::string kInsertYield =
    std::string(
        "INSERT INTO yield (draw, amplitude_mm, trials, survivors, undecided, share, share_low, "
        "share_high, \"commit\", made_at, from_deg) "
        "SELECT ?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, coalesce(?11, ") +
    kThresholdSql +
    ") "
    "WHERE EXISTS (SELECT 1 FROM candidate WHERE draw = ?1) "
    "ON CONFLICT (draw, amplitude_mm, from_deg) DO UPDATE SET trials = excluded.trials, "
    "survivors = excluded.survivors, undecided = excluded.undecided, share = excluded.share, "
    "share_low = excluded.share_low, share_high = excluded.share_high, "
    "\"commit\" = excluded.\"commit\", made_at = excluded.made_at "
    "WHERE excluded.trials > yield.trials";
constexpr const char* kColumns =
    "draw, amplitude_mm, trials, survivors, undecided, share, share_low, share_high, \"commit\", "
    "made_at, from_deg";
constexpr int kColumnCount = 11;

// Copies yields, each to the candidate with the number that `renumber` returns, if any.
template <class Renumber>
void copy(SQLite::Database& from, SQLite::Database& into, const std::string& which,
          const Renumber& renumber) {
  SQLite::Statement select =
      prepared(from, std::string("SELECT ") + kColumns + " FROM yield " + which);
  SQLite::Statement insert(into, kInsertYield);
  copy_rows(from, select, insert, [&] {
    const std::optional<std::uint64_t> draw = renumber(draw_of(select.getColumn(0)));
    bind_value(insert, 1, draw);  // null: of no candidate
    for (int k = 1; k < kColumnCount; ++k) bind_value(insert, k + 1, select.getColumn(k));
  });
}

// Quantiles of other libraries may differ in their last digits.
bool agree(const Json& stored, const Json& recomputed) {
  constexpr double kLastDigits = 1e-9;
  if (stored.is_null() || recomputed.is_null()) return stored == recomputed;
  return std::abs(stored.get<double>() - recomputed.get<double>()) <= kLastDigits;
}

}  // namespace

Json yield_json(const Yield& yield) {
  const std::uint64_t decided = yield.trials - yield.undecided;
  const auto [low, high] = share_interval(yield.survivors, yield.undecided, yield.trials);
  Json json = {{"amplitude_mm", yield.amplitude_mm},
               {"trials", yield.trials},
               {"survivors", yield.survivors},
               {"undecided", yield.undecided},
               {"share", decided > 0 ? Json(static_cast<double>(yield.survivors) /
                                            static_cast<double>(decided))
                                     : Json()},
               {"share_low", low},
               {"share_high", high}};
  if (yield.from_deg) json["from_deg"] = *yield.from_deg;
  return json;
}

Json yields_json(const std::vector<Yield>& yields) { return json_list(yields, yield_json); }

std::vector<std::uint64_t> write_yields(SQLite::Database& database,
                                        const std::vector<Yield>& yields,
                                        const std::string& commit) {
  std::vector<std::uint64_t> no_candidates;
  SQLite::Statement insert(database, kInsertYield);
  SQLite::Statement candidate(database, "SELECT 1 FROM candidate WHERE draw = ?");
  const std::string now = database.execAndGet("SELECT strftime('%Y-%m-%dT%H:%M:%fZ')").getString();
  for (const Yield& yield : yields) {
    const Json json = yield_json(yield);
    execute(insert, yield.draw, yield.amplitude_mm, yield.trials, yield.survivors, yield.undecided,
            json["share"].is_null() ? std::nullopt : std::optional(json["share"].get<double>()),
            json["share_low"].get<double>(), json["share_high"].get<double>(), commit, now,
            yield.from_deg);
    bind_all(candidate, yield.draw);
    if (!candidate.executeStep()) no_candidates.push_back(yield.draw);
  }
  return no_candidates;
}

std::vector<Yield> read_yields(SQLite::Database& database, std::uint64_t draw) {
  return reading(database, [&] {
    std::vector<Yield> yields;
    SQLite::Statement row =
        bound(database,
              std::string("SELECT amplitude_mm, trials, survivors, undecided, CASE WHEN "
                          "abs(from_deg - ") +
                  kThresholdSql +
                  ") >= 1e-9 THEN from_deg END FROM yield WHERE draw = ? "
                  "ORDER BY amplitude_mm, from_deg",
              draw);
    while (row.executeStep()) {
      yields.push_back({draw,
                        row.getColumn(0).getDouble(),
                        draw_of(row.getColumn(1)),
                        draw_of(row.getColumn(2)),
                        draw_of(row.getColumn(3)),
                        {}});
      if (!row.getColumn(4).isNull()) yields.back().from_deg = row.getColumn(4).getDouble();
      if (!yields.back().adds_up()) {
        throw damaged(database, "the copies of draw " + std::to_string(draw) + " off by " +
                                    shown_number(yields.back().amplitude_mm) + " mm do not add up");
      }
    }
    return yields;
  });
}

void copy_yields(SQLite::Database& from, SQLite::Database& into) {
  copy(from, into, "ORDER BY draw, amplitude_mm, from_deg",
       [&](std::uint64_t draw) { return number_in(into, from, draw); });
}

void hand_on_yields(SQLite::Database& database, std::uint64_t from, std::uint64_t to) {
  copy(database, database, "WHERE draw = " + std::to_string(from),
       [to](std::uint64_t) { return to; });
}

std::vector<Finding> check_yields(SQLite::Database& database) {
  std::vector<Finding> findings;
  SQLite::Statement row(database,
                        "SELECT yield.draw, amplitude_mm, trials, survivors, undecided, share, "
                        "share_low, share_high, candidate.draw IS NOT NULL, from_deg "
                        "FROM yield LEFT JOIN candidate USING (draw) "
                        "ORDER BY yield.draw, amplitude_mm, from_deg");
  while (row.executeStep()) {
    const Yield yield{draw_of(row.getColumn(0)), row.getColumn(1).getDouble(),
                      draw_of(row.getColumn(2)), draw_of(row.getColumn(3)),
                      draw_of(row.getColumn(4)), {}};
    const std::string where = "draw " + std::to_string(yield.draw) + ", copies off by " +
                              shown_number(yield.amplitude_mm) + " mm, from " +
                              shown_number(row.getColumn(9).getDouble()) + " deg";
    if (row.getColumn(8).getInt() == 0) {
      findings.push_back(differs(where, "yield.draw", yield.draw, "a candidate's"));
    }
    if (!yield.adds_up()) {
      findings.push_back(differs(where, "yield.survivors", row.getColumn(3).getInt64(),
                                 "at most trials less undecided"));
      continue;
    }
    const Json recomputed = yield_json(yield);
    const char* const kShares[] = {"share", "share_low", "share_high"};
    for (int k = 0; k < 3; ++k) {
      const SQLite::Column cell = row.getColumn(5 + k);
      const Json stored = cell.isNull() ? Json() : Json(cell.getDouble());
      if (agree(stored, recomputed[kShares[k]])) continue;
      findings.push_back(
          differs(where, std::string("yield.") + kShares[k], stored, recomputed[kShares[k]]));
    }
  }
  return findings;
}

}  // namespace misalign::schema
