#include "schema/catalogue/campaign_check.hpp"

#include <cmath>

#include "schema/catalogue/candidate_row.hpp"
#include "schema/catalogue/since.hpp"

namespace misalign::schema {
namespace {

// A length of paper from two coordinates: rounding of a square root.
constexpr double kRounding = 1e-14;

bool same_diagonals(const Json& stored, const Json& recomputed) {
  if (!stored.is_array() || stored.size() != recomputed.size()) return false;
  for (std::size_t k = 0; k < stored.size(); ++k) {
    Json a = stored[k], b = recomputed[k];
    if (!a.is_object() || !a.contains("flat_mm") || !a["flat_mm"].is_number()) return false;
    const double a_mm = a["flat_mm"].get<double>(), b_mm = b["flat_mm"].get<double>();
    a.erase("flat_mm");
    b.erase("flat_mm");
    if (a != b || !(std::abs(a_mm - b_mm) <= kRounding * b_mm)) return false;
  }
  return true;
}

void check_diagonals(SQLite::Database& database, const Campaign& campaign,
                     std::vector<Finding>& findings) {
  const solver::PerforatedSheet& base = campaign.pattern.base;
  const solver::Mechanism mechanism = solver::build_mechanism(base.sheet, base.holes, base.folding);
  const Json recomputed = diagonals_json(campaign, mechanism);
  SQLite::Statement row(database, "SELECT diagonals FROM campaign");
  if (!row.executeStep()) return;  // which was found before
  const std::string text = text_of(row.getColumn(0));
  if (same_diagonals(json_of(text), recomputed)) return;
  findings.push_back(differs("campaign", "diagonals", text, recomputed.dump()));
}

void check_goal(SQLite::Database& database, const CatalogueState& state,
                std::vector<Finding>& findings) {
  const std::uint64_t end = goal_end_of_rows(database, state.goal).value();
  if (end != state.goal_end) {
    findings.push_back(differs("campaign", "goal_end", state.goal_end, end));
  }
}

}  // namespace

void check_campaign_row(SQLite::Database& database, const Campaign& campaign,
                        const std::optional<CatalogueState>& state,
                        std::vector<Finding>& findings) {
  check_diagonals(database, campaign, findings);
  if (state) check_goal(database, *state, findings);
}

void check_runs(SQLite::Database& database, std::vector<Finding>& findings) {
  const int version = version_of(database);
  const auto cost = [&](const char* column) { return ", " + column_sql("run", column, version); };
  SQLite::Statement row(database,
                        "SELECT run.id, ranks, count(unit.lo), max(worker), "
                        "EXISTS (SELECT 1 FROM run WHERE \"end\" = 'merged')" +
                            cost("commits") + cost("commit_s") + cost("longest_commit_s") +
                            " FROM run LEFT JOIN unit ON unit.run = run.id GROUP BY run.id");
  while (row.executeStep()) {
    const std::string where = "run " + text_of(row.getColumn(0));
    const std::int64_t ranks = row.getColumn(1).getInt64(), units = row.getColumn(2).getInt64();
    const std::int64_t worker = row.getColumn(3).getInt64(), commits = row.getColumn(5).getInt64();
    if (units > 0 && worker >= ranks) {
      findings.push_back(
          differs(where, "ranks", ranks, "above its worker " + std::to_string(worker)));
    }
    const bool is_joined = row.getColumn(4).getInt() != 0;
    if (!is_joined && commits > units) {
      findings.push_back(
          differs(where, "commits", commits, "at most its " + std::to_string(units) + " units"));
    }
    const double all_s = row.getColumn(6).getDouble(), longest_s = row.getColumn(7).getDouble();
    if (longest_s > all_s) {
      findings.push_back(differs(where, "longest_commit_s", longest_s, all_s));
    }
  }
}

}  // namespace misalign::schema
