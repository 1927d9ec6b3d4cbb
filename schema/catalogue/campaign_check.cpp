#include "schema/catalogue/campaign_check.hpp"

#include <fmt/format.h>

#include <cmath>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/candidate_row.hpp"

namespace misalign::schema {
namespace {

// Relative rounding of a flat length that comes from two coordinates.
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
  const solver::Mechanism mechanism = solver::build_mechanism(base);
  const Json recomputed = diagonals_json(campaign, mechanism);
  SQLite::Statement row(database, "SELECT diagonals FROM campaign");
  if (!row.executeStep()) return;  // reported before
  const std::string text = text_of(row.getColumn(0));
  if (same_diagonals(json_of(text), recomputed)) return;
  findings.push_back(differs("campaign", "diagonals", text, recomputed.dump()));
}

// Since this schema version runs count every rejected draw once as screened.
constexpr int kScreenedOnceSince = 3;

bool is_sample(double deg, const Campaign& campaign) {
  const double sample = deg / campaign.sample_deg;
  return deg >= 0 && deg <= campaign.end_deg + campaign.sample_deg / 2 &&
         std::abs(sample - std::round(sample)) <= 1e-9 * sample;
}

// Adds a finding unless the run's configuration belongs to this campaign.
void check_configuration(const std::string& where, const std::string& text,
                         const Campaign& campaign, std::vector<Finding>& findings) {
  std::string found;
  try {
    found = identity(read_campaign(parse_json(text, where), where));
  } catch (const UserError&) {
    found = "none";
  }
  const std::string wanted = identity(campaign);
  if (found != wanted) findings.push_back(differs(where, "configuration", found, wanted));
}

}  // namespace

std::optional<Finding> goal_fault(SQLite::Database& database, const CatalogueState& state) {
  const std::uint64_t end = goal_end_of_rows(database, state.goal).value();
  if (end == state.goal_end) return std::nullopt;
  return differs("campaign", "goal_end", state.goal_end, end);
}

void check_campaign_row(SQLite::Database& database, const Campaign& campaign,
                        const std::optional<CatalogueState>& state,
                        std::vector<Finding>& findings) {
  check_diagonals(database, campaign, findings);
  if (!state) return;
  if (const auto fault = goal_fault(database, *state)) findings.push_back(*fault);
}

void check_screened(SQLite::Database& database, const Campaign& campaign,
                    std::vector<Finding>& findings) {
  std::uint64_t screened = 0, rejected = 0;
  SQLite::Statement row(database, "SELECT tested_deg, draws FROM screened");
  while (row.executeStep()) {
    screened += draw_of(row.getColumn(1));
    const double tested_deg = row.getColumn(0).getDouble();
    if (!is_sample(tested_deg, campaign) || row.getColumn(1).getInt64() <= 0) {
      findings.push_back(
          differs("screened", "row", Json{tested_deg, row.getColumn(1).getInt64()}, Json()));
    }
  }
  if (!campaign.search.splitting) {
    SQLite::Statement units(database, "SELECT rejected FROM unit");
    while (units.executeStep()) rejected += draw_of(units.getColumn(0));
  }
  // A joined catalogue has all screened counts, but perhaps only a part of the units.
  SQLite::Statement more(
      database, "SELECT EXISTS (SELECT 1 FROM run WHERE \"end\" = 'merged' OR schema_version < " +
                    std::to_string(kScreenedOnceSince) + ")");
  more.executeStep();
  const bool may_be_more = more.getColumn(0).getInt() != 0;
  if (may_be_more ? screened < rejected : screened != rejected) {
    findings.push_back(differs("screened", "draws", screened, rejected));
  }
}

namespace {

// Pairs a column with its condition.
struct AscentRule {
  const char* column;
  const char* can_be;
  std::string holds;
};

// The draw is kept as drawn, or an ascent starts from it.
std::vector<AscentRule> rules_of(const Optimisation& asked) {
  const std::string kept = "ended IN ('breaks_a_limit', 'has_no_value')";
  return {{"start_value", "a value, or none if the draw is kept unchanged",
           "iif(" + kept + ", start_value IS NULL, start_value > 0)"},
          {"end_value", "more than at the start after a step, and the same without one",
           "iif(" + kept +
               ", end_value IS NULL, iif(steps = 0, end_value = start_value, "
               "end_value > start_value AND end_value < 9e999))"},
          {"steps", "the number that its end implies",
           fmt::format("iif({0}, steps = 0, steps >= 0 AND iif(ended = 'most_steps', steps = {1}, "
                       "steps < {1}))",
                       kept, asked.most_steps)},
          {"sheets_folded", "at least one for each step",
           "iif(" + kept + ", sheets_folded = 0, sheets_folded >= steps)"},
          {"ended", "a known reason", "ended IN ('no_step_is_better', 'most_steps') OR " + kept},
          {"limited_by", "none",
           fmt::format("limited_by IS NULL OR NOT ({} OR {:d})", kept, asked.ternary)}};
}

// Distances from the target, which a start need not have.
std::vector<AscentRule> rules_of_shapes() {
  return {{"start_value", "a distance, or none",
           "start_value IS NULL OR start_value >= 0 AND start_value < 9e999"},
          {"end_value", "a distance", "end_value >= 0 AND end_value < 9e999"},
          {"sheets_folded", "at least one for each step", "sheets_folded > steps"},
          {"ended", "the only reason", "ended = 'no_step_is_better'"},
          {"limited_by", "none", "limited_by IS NULL"}};
}

}  // namespace

void check_ascents(SQLite::Database& database, const Campaign& campaign,
                   std::vector<Finding>& findings) {
  if (!campaign.search.has_ends()) {
    if (!database.tableExists("ascent")) return;
    const std::int64_t rows = database.execAndGet("SELECT count(*) FROM ascent").getInt64();
    if (rows > 0) findings.push_back(differs("catalogue", "rows of ascent", rows, 0));
    return;
  }
  const std::vector<AscentRule> rules =
      campaign.search.shape ? rules_of_shapes() : rules_of(*campaign.search.optimisation);
  std::string columns;
  for (const AscentRule& rule : rules) {
    columns += fmt::format(", {}, coalesce({}, 0)", rule.column, rule.holds);
  }
  SQLite::Statement row(database, "SELECT candidate.draw, ascent.draw IS NULL" + columns +
                                      " FROM candidate LEFT JOIN ascent USING (draw)");
  while (row.executeStep()) {
    const std::string where = "draw " + std::to_string(draw_of(row.getColumn(0)));
    if (row.getColumn(1).getInt() != 0) {
      findings.push_back(differs(where, "ascent", "none", "one"));
      continue;
    }
    int column = 2;
    for (const AscentRule& rule : rules) {
      if (row.getColumn(column + 1).getInt() == 0) {
        const SQLite::Column stored = row.getColumn(column);
        findings.push_back(differs(where, std::string("ascent.") + rule.column,
                                   stored.isNull() ? Json() : Json(text_of(stored)), rule.can_be));
      }
      column += 2;
    }
  }
}

void check_level(const std::string& where, const LevelCount& level, const Splitting& splitting,
                 std::vector<Finding>& findings) {
  const auto compare = [&](const char* column, std::uint64_t stored, std::uint64_t expected) {
    if (stored == expected) return;
    const std::string name = fmt::format("level {}, {}", level.level, column);
    findings.push_back(differs(where, name, stored, expected));
  };
  const bool is_first = level.level == 0;
  const std::uint64_t particles = is_first ? splitting.first_draws : splitting.particles;
  compare("particles", level.particles, particles);
  compare("tried", level.tried, is_first ? particles : particles * splitting.sweeps);
  if (is_first) compare("taken", level.taken, level.survivors);
}

void check_runs(SQLite::Database& database, const Campaign& campaign,
                std::vector<Finding>& findings) {
  const int version = version_of(database);
  SQLite::Statement row(database,
                        "SELECT run.id, ranks, count(unit.lo), max(worker), "
                        "EXISTS (SELECT 1 FROM run WHERE \"end\" = 'merged'), commits, commit_s, "
                        "longest_commit_s, schema_version, "
                        "julianday(started_at), ended_at IS NULL = (\"end\" IS NULL), "
                        "ended_at IS NULL OR julianday(ended_at), min(seconds), max(seconds) "
                        "FROM run LEFT JOIN unit ON "
                        "unit.run = run.id GROUP BY run.id");
  while (row.executeStep()) {
    const std::string where = "run " + text_of(row.getColumn(0));
    const auto add = [&](const char* column, const Json& stored, const Json& expected) {
      findings.push_back(differs(where, column, stored, expected));
    };
    const std::int64_t ranks = row.getColumn(1).getInt64(), units = row.getColumn(2).getInt64();
    const std::int64_t worker = row.getColumn(3).getInt64(), commits = row.getColumn(5).getInt64();
    if (units > 0 && worker >= ranks) {
      add("ranks", ranks, "above its worker " + std::to_string(worker));
    }
    const bool is_joined = row.getColumn(4).getInt() != 0;
    if (!is_joined && commits > units) {
      add("commits", commits, "at most its " + std::to_string(units) + " units");
    }
    if (commits < 0) add("commits", commits, "a count");
    const double all_s = row.getColumn(6).getDouble(), longest_s = row.getColumn(7).getDouble();
    if (longest_s > all_s) add("longest_commit_s", longest_s, all_s);
    if (!(longest_s >= 0)) add("longest_commit_s", longest_s, "a time");
    const double least_s = row.getColumn(12).getDouble(), most_s = row.getColumn(13).getDouble();
    if (units > 0 && !(least_s >= 0 && std::isfinite(most_s))) {
      findings.push_back(differs("units of " + where, "seconds",
                                 fmt::format("{} to {}", least_s, most_s), "times"));
    }
    const int written_by = row.getColumn(8).getInt();
    if (written_by < 1 || written_by > version) {
      add("schema_version", written_by, "one of 1 to " + std::to_string(version));
    }
    if (row.getColumn(9).isNull()) add("started_at", "no time", "a time");
    if (row.getColumn(10).getInt() == 0 || row.getColumn(11).isNull()) {
      add("ended_at", "none, or no time", "a time beside its end");
    }
  }
  // Groups runs by configuration: most runs of a campaign share it.
  SQLite::Statement configuration(
      database, "SELECT min(id), configuration FROM run GROUP BY configuration ORDER BY 1");
  while (configuration.executeStep()) {
    check_configuration("run " + text_of(configuration.getColumn(0)),
                        text_of(configuration.getColumn(1)), campaign, findings);
  }
}

}  // namespace misalign::schema
