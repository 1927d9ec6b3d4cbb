#include "schema/catalogue.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "schema/carried_files.hpp"
#include "schema/folding_json.hpp"

namespace misalign::schema {
namespace {

const std::string& carried_text(const std::string& path) {
  for (const CarriedFile& file : carried_files()) {
    if (file.path == path) return file.text;
  }
  throw std::logic_error(path + " is not carried");
}

std::int64_t stored(std::uint64_t draw) { return static_cast<std::int64_t>(draw); }

void bind_or_null(SQLite::Statement& statement, const char* name,
                  const std::optional<std::uint64_t>& value) {
  value ? statement.bind(name, stored(*value)) : statement.bind(name);
}

Json diagonals_json(const Campaign& campaign, const solver::Mechanism& mechanism) {
  const auto& vertices = campaign.pattern.base.sheet.vertices_mm;
  Json list = Json::array();
  for (const solver::Diagonal& diagonal : mechanism.diagonals) {
    const double flat_mm = (vertices.col(diagonal.from) - vertices.col(diagonal.to)).norm();
    list.push_back(diagonal_json(campaign.pattern, mechanism, diagonal, flat_mm));
  }
  return list;
}

// Nine decimals: 1e-9 of a length of 100 mm is below what any maker can cut.
Json elongations_json(const std::vector<double>& elongation) {
  Json list = Json::array();
  for (const double e : elongation) list.push_back(std::round(e * 1e9) / 1e9);
  return list;
}

// The accepted goal is met at the first multiple of the granule whose prefix holds as many; a count
// of zero is met at once.
std::uint64_t end_by_accepted(SQLite::Database& database, const Goal& goal,
                              std::uint64_t planned_end) {
  if (!goal.accepted) return planned_end;
  if (*goal.accepted == 0) return goal.range.lo;
  SQLite::Statement nth(
      database, "SELECT draw FROM candidate WHERE draw >= ? ORDER BY draw LIMIT 1 OFFSET ?");
  nth.bind(1, stored(goal.range.lo));
  nth.bind(2, stored(*goal.accepted - 1));
  if (!nth.executeStep()) return planned_end;
  const auto draw = static_cast<std::uint64_t>(nth.getColumn(0).getInt64());
  const std::uint64_t granules = (draw - goal.range.lo) / kAcceptedGranule + 1;
  const std::uint64_t end = goal.range.lo + granules * kAcceptedGranule;
  if (end >= planned_end) return planned_end;
  // Only a prefix without gaps decides.
  std::uint64_t reached = goal.range.lo;
  SQLite::Statement units(database, "SELECT lo, hi FROM unit WHERE hi > ? AND lo < ? ORDER BY lo");
  units.bind(1, stored(goal.range.lo));
  units.bind(2, stored(end));
  while (units.executeStep()) {
    if (static_cast<std::uint64_t>(units.getColumn(0).getInt64()) > reached) break;
    reached = static_cast<std::uint64_t>(units.getColumn(1).getInt64());
  }
  return reached >= end ? end : planned_end;
}

}  // namespace

std::uint64_t Goal::planned_end() const {
  if (!draws || *draws >= range.size()) return range.hi;
  return range.lo + *draws;
}

Catalogue::Catalogue(const std::string& path, const Campaign& campaign,
                     const solver::Mechanism& mechanism)
    : campaign_(campaign),
      mechanism_(mechanism),
      identity_(identity(campaign)),
      lock_(path),
      database_(open_for_writing(path)) {
  const bool is_new = database_->execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0;
  if (!is_new) {
    check_same_campaign(path);
    migrate(path);
  }
  database_->exec("PRAGMA journal_mode = WAL");
  if (is_new) create();
}

void Catalogue::check_same_campaign(const std::string& path) const {
  const std::string held = database_->execAndGet("SELECT identity FROM campaign").getString();
  if (held == identity_) return;
  const Json theirs = identity_json(read_campaign_of(*database_, path));
  std::string differences;
  for (const Json& change : Json::diff(theirs, identity_json(campaign_))) {
    differences += (differences.empty() ? "" : ", ") + change.at("path").get<std::string>();
  }
  throw UserError(kExitOtherCampaign, path + ": holds another campaign, " + held.substr(0, 8) +
                                          " (they differ in " + differences +
                                          "); give this one a file of its own with --catalogue");
}

// The file as it was is kept beside it; then all steps to the present schema, or none.
void Catalogue::migrate(const std::string& path) {
  const int version = database_->execAndGet("PRAGMA user_version").getInt();
  if (version == kSchemaVersion) return;
  const std::string backup = path + ".version-" + std::to_string(version);
  if (!std::filesystem::exists(backup)) {
    SQLite::Statement copy(*database_, "VACUUM INTO ?");
    copy.bind(1, backup);
    copy.exec();
  }
  SQLite::Transaction transaction(*database_);
  for (int next = version + 1; next <= kSchemaVersion; ++next) {
    database_->exec(carried_text("schema/migrations/" + std::to_string(next) + ".sql"));
  }
  transaction.commit();
}

void Catalogue::create() {
  SQLite::Transaction transaction(*database_);
  database_->exec(carried_text("schema/catalogue.sql"));
  SQLite::Statement insert(
      *database_,
      "INSERT INTO campaign (id, identity, name, configuration, diagonals, "
      "range_lo, range_hi, goal_end) "
      "VALUES (1, :identity, :name, :configuration, :diagonals, 0, :end, :end)");
  insert.bind(":identity", identity_);
  insert.bind(":name", campaign_.name);
  insert.bind(":configuration", campaign_json(campaign_).dump());
  insert.bind(":diagonals", diagonals_json(campaign_, mechanism_).dump());
  insert.bind(":end", stored(kEndOfDraws));
  insert.exec();
  transaction.commit();
}

std::vector<DrawRange> Catalogue::done() const {
  std::vector<DrawRange> ranges;
  SQLite::Statement units(*database_, "SELECT lo, hi FROM unit ORDER BY lo");
  while (units.executeStep()) {
    ranges.push_back({static_cast<std::uint64_t>(units.getColumn(0).getInt64()),
                      static_cast<std::uint64_t>(units.getColumn(1).getInt64())});
  }
  return ranges;
}

void Catalogue::begin_run(const RunInfo& run, const Goal& goal) {
  goal_ = goal;
  SQLite::Statement other(*database_,
                          "SELECT \"commit\" FROM run WHERE golden_verdicts != ? LIMIT 1");
  other.bind(1, run.golden_verdicts);
  if (other.executeStep()) {
    throw UserError(kExitOtherCampaign, "this build (commit " + run.commit +
                                            ") gives other verdicts on the golden draws "
                                            "than the one that worked on this catalogue (commit " +
                                            other.getColumn(0).getString() +
                                            "); use that build, or another --catalogue");
  }
  SQLite::Transaction transaction(*database_);
  SQLite::Statement campaign(*database_,
                             "UPDATE campaign SET name = :name, configuration = :configuration, "
                             "range_lo = :lo, range_hi = :hi, goal_draws = :draws, "
                             "goal_accepted = :accepted, goal_end = :end");
  const std::string configuration = campaign_json(campaign_).dump();
  goal_end_ = end_by_accepted(*database_, goal_, goal_.planned_end());
  campaign.bind(":name", campaign_.name);
  campaign.bind(":configuration", configuration);
  campaign.bind(":lo", stored(goal.range.lo));
  campaign.bind(":hi", stored(goal.range.hi));
  bind_or_null(campaign, ":draws", goal.draws);
  bind_or_null(campaign, ":accepted", goal.accepted);
  campaign.bind(":end", stored(goal_end_));
  campaign.exec();
  SQLite::Statement insert(
      *database_,
      "INSERT INTO run (started_at, host, ranks, version, \"commit\", compiler, flags, "
      "golden_verdicts, configuration, schema_version) VALUES (strftime('%Y-%m-%dT%H:%M:%fZ'), "
      ":host, :ranks, "
      ":version, :commit, :compiler, :flags, :golden, :configuration, :schema)");
  insert.bind(":host", run.host);
  insert.bind(":ranks", run.ranks);
  insert.bind(":version", run.version);
  insert.bind(":commit", run.commit);
  insert.bind(":compiler", run.compiler);
  insert.bind(":flags", run.flags);
  insert.bind(":golden", run.golden_verdicts);
  insert.bind(":configuration", configuration);
  insert.bind(":schema", kSchemaVersion);
  insert.exec();
  run_ = database_->getLastInsertRowid();
  transaction.commit();
}

void Catalogue::commit(const UnitRecord& unit, int worker) {
  SQLite::Transaction transaction(*database_);
  const std::int64_t lo = stored(unit.range.lo);

  CandidateSum sum;
  for (const Candidate& candidate : unit.candidates) {
    sum.add(candidate.draw, candidate.metrics.deploys_from_sample);
  }
  const auto part = sum.bytes();
  SQLite::Statement insert_unit(*database_,
                                "INSERT INTO unit (lo, hi, run, worker, accepted, rejected, "
                                "undecided, seconds, digest_part) VALUES (?,?,?,?,?,?,?,?,?)");
  insert_unit.bind(1, lo);
  insert_unit.bind(2, stored(unit.range.hi));
  insert_unit.bind(3, run_);
  insert_unit.bind(4, worker);
  insert_unit.bind(5, stored(unit.accepted));
  insert_unit.bind(6, stored(unit.rejected));
  insert_unit.bind(7, stored(unit.undecided.size()));
  insert_unit.bind(8, unit.seconds);
  insert_unit.bind(9, part.data(), static_cast<int>(part.size()));
  insert_unit.exec();

  SQLite::Statement insert_candidate(
      *database_, "INSERT INTO candidate VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
  for (const Candidate& candidate : unit.candidates) {
    const solver::Metrics& m = candidate.metrics;
    int column = 0;
    const auto bind = [&](const auto& value) { insert_candidate.bind(++column, value); };
    bind(stored(candidate.draw));
    bind(lo);
    bind(m.deploys_from_sample);
    for (const double value : {m.deploys_from_deg, m.fold_limit_deg, m.elongation_min,
                               m.elongation_max, m.stroke_min, m.stroke_max}) {
      bind(value);
    }
    const auto bind_optional = [&](const std::optional<double>& value) {
      value ? bind(*value) : insert_candidate.bind(++column);
    };
    bind_optional(m.slope_min_mm_per_deg);
    for (const double value : {m.stretch_sq_mm2, m.singular_value_min, m.residual_max,
                               m.isometry_error_mm, m.kawasaki_defect_deg}) {
      bind(value);
    }
    for (const int value : {m.shifted_vertices, m.increasing, m.decreasing}) bind(value);
    bind(displacements_json(candidate.shifts_mm).dump());
    bind(elongations_json(m.elongation).dump());
    bind_optional(m.slope_between_min_mm_per_deg);
    bind_optional(m.bump_deg);
    insert_candidate.exec();
    insert_candidate.reset();
  }

  SQLite::Statement insert_undecided(*database_, "INSERT INTO undecided VALUES (?,?,?,?)");
  for (const DrawVerdict& draw : unit.undecided) {
    insert_undecided.bind(1, stored(draw.draw));
    insert_undecided.bind(2, lo);
    insert_undecided.bind(3, undecided_cause(draw.verdict));
    insert_undecided.bind(4, run_);
    insert_undecided.exec();
    insert_undecided.reset();
  }

  SQLite::Statement insert_sample(*database_, "INSERT INTO fault_sample VALUES (?,?,?,?,?,?)");
  for (const DrawVerdict& draw : unit.fault_sample) {
    const std::string where = where_label(mechanism_, draw.verdict);
    const int fault_sample = draw.verdict.fault_sample();
    insert_sample.bind(1, stored(draw.draw));
    insert_sample.bind(2, lo);
    insert_sample.bind(3, draw.verdict.deploys_from_sample);
    insert_sample.bind(4, solver::fault_name(draw.verdict.first_fault));
    fault_sample > 0 ? insert_sample.bind(5, fault_sample * campaign_.sample_deg)
                     : insert_sample.bind(5);
    where.empty() ? insert_sample.bind(6) : insert_sample.bind(6, where);
    insert_sample.exec();
    insert_sample.reset();
  }

  SQLite::Statement add_screened(*database_,
                                 "INSERT INTO screened VALUES (?,?,?) ON CONFLICT DO UPDATE "
                                 "SET draws = draws + excluded.draws");
  for (const auto& [seen, draws] : unit.screened) {
    add_screened.bind(1, solver::fault_name(static_cast<solver::Fault>(seen.first)));
    add_screened.bind(2, seen.second * campaign_.sample_deg);
    add_screened.bind(3, stored(draws));
    add_screened.exec();
    add_screened.reset();
  }

  update_goal_end();
  transaction.commit();
}

void Catalogue::update_goal_end() {
  if (!goal_.accepted) return;
  goal_end_ = end_by_accepted(*database_, goal_, goal_.planned_end());
  SQLite::Statement update(*database_, "UPDATE campaign SET goal_end = ?");
  update.bind(1, stored(goal_end_));
  update.exec();
}

void Catalogue::end_run(const std::string& end) {
  SQLite::Statement update(
      *database_, "UPDATE run SET ended_at = strftime('%Y-%m-%dT%H:%M:%fZ'), end = ? WHERE id = ?");
  update.bind(1, end);
  update.bind(2, run_);
  update.exec();
  // A finished catalogue is one plain file, readable in a directory that nobody may write to. A
  // reader that is looking just now prevents that, which does no harm.
  try {
    database_->setBusyTimeout(0);
    database_->exec("PRAGMA journal_mode = DELETE");
  } catch (const SQLite::Exception&) {
  }
}

CatalogueState read_state(SQLite::Database& database) {
  SQLite::Transaction snapshot(database);  // one moment for all that follows
  CatalogueState state{};
  SQLite::Statement campaign(database,
                             "SELECT identity, name, range_lo, range_hi, goal_draws, "
                             "goal_accepted, goal_end FROM campaign");
  campaign.executeStep();
  const auto draw = [](const SQLite::Column& column) {
    return static_cast<std::uint64_t>(column.getInt64());
  };
  const auto optional_draw = [&](const SQLite::Column& column) {
    return column.isNull() ? std::nullopt : std::optional(draw(column));
  };
  state.identity = campaign.getColumn(0).getString();
  state.name = campaign.getColumn(1).getString();
  state.goal.range = {draw(campaign.getColumn(2)), draw(campaign.getColumn(3))};
  state.goal.draws = optional_draw(campaign.getColumn(4));
  state.goal.accepted = optional_draw(campaign.getColumn(5));
  state.goal_end = draw(campaign.getColumn(6));

  const auto count = [&](const std::string& sql) {
    SQLite::Statement statement(database, sql);
    statement.executeStep();
    return draw(statement.getColumn(0));
  };
  state.draws_in_ledger = count("SELECT coalesce(sum(draws), 0) FROM unit");
  std::vector<DrawRange> ranges;
  CandidateSum sum;
  SQLite::Statement units(database, "SELECT lo, hi, digest_part FROM unit ORDER BY lo");
  std::uint64_t cut_from = kEndOfDraws;  // candidates of the unit that straddles the end
  while (units.executeStep()) {
    const DrawRange range{draw(units.getColumn(0)), draw(units.getColumn(1))};
    ranges.push_back(range);
    if (range.hi <= state.goal_end) {
      sum.add(CandidateSum::from_bytes(
          static_cast<const unsigned char*>(units.getColumn(2).getBlob())));
    } else if (range.lo < state.goal_end) {
      cut_from = range.lo;
    }
  }
  SQLite::Statement cut(
      database, "SELECT draw, deploys_from_sample FROM candidate WHERE draw >= ? AND draw < ?");
  cut.bind(1, stored(cut_from));
  cut.bind(2, stored(state.goal_end));
  while (cut.executeStep()) sum.add(draw(cut.getColumn(0)), cut.getColumn(1).getInt());

  const std::vector<DrawRange> merged = merged_up_to(ranges, state.goal_end);
  for (const DrawRange& range : merged) state.draws += range.size();
  const std::string below_end = " WHERE draw < " + std::to_string(state.goal_end);
  state.accepted = count("SELECT count(*) FROM candidate" + below_end);
  state.undecided = count("SELECT count(*) FROM undecided" + below_end);
  state.rejected = state.draws - state.accepted - state.undecided;
  state.digest = catalogue_digest(state.identity, merged, state.accepted, state.undecided, sum);

  SQLite::Statement gaps(database, "SELECT lo, hi FROM gaps ORDER BY lo");
  while (gaps.executeStep()) {
    state.gaps.push_back({draw(gaps.getColumn(0)), draw(gaps.getColumn(1))});
  }
  SQLite::Statement faults(database,
                           "SELECT first_fault, count(*) FROM fault_sample WHERE draw NOT IN "
                           "(SELECT draw FROM candidate) GROUP BY first_fault");
  while (faults.executeStep()) {
    state.faults[faults.getColumn(0).getString()] = draw(faults.getColumn(1));
  }
  SQLite::Statement speed(database,
                          "SELECT sum(draws) * ranks / sum(seconds) FROM unit JOIN run ON run.id = "
                          "unit.run WHERE run = (SELECT max(run) FROM unit)");
  if (speed.executeStep()) state.draws_per_s = speed.getColumn(0).getDouble();
  return state;
}

Campaign read_campaign_of(SQLite::Database& database, const std::string& path) {
  SQLite::Statement row(database, "SELECT configuration FROM campaign");
  row.executeStep();
  return read_campaign(Json::parse(row.getColumn(0).getString()), path + ", its configuration");
}

std::vector<std::uint64_t> candidate_draws(SQLite::Database& database) {
  std::vector<std::uint64_t> draws;
  SQLite::Statement row(database, "SELECT draw FROM candidate ORDER BY draw");
  while (row.executeStep()) {
    draws.push_back(static_cast<std::uint64_t>(row.getColumn(0).getInt64()));
  }
  return draws;
}

int schema_version_of(SQLite::Database& database, std::uint64_t draw) {
  if (database.execAndGet("PRAGMA user_version").getInt() < 2) return 1;
  SQLite::Statement row(database,
                        "SELECT schema_version FROM candidate JOIN unit ON unit.lo = "
                        "candidate.unit JOIN run ON run.id = unit.run WHERE draw = ?");
  row.bind(1, stored(draw));
  return row.executeStep() ? row.getColumn(0).getInt() : kSchemaVersion;
}

Json read_candidate(SQLite::Database& database, std::uint64_t draw) {
  SQLite::Statement row(database, "SELECT * FROM candidate WHERE draw = ?");
  row.bind(1, stored(draw));
  if (!row.executeStep()) return nullptr;
  Json json;
  for (int k = 0; k < row.getColumnCount(); ++k) {
    const SQLite::Column value = row.getColumn(k);
    Json& into = json[row.getColumnName(k)];
    if (value.isInteger()) into = value.getInt64();
    if (value.isFloat()) into = value.getDouble();
    if (value.isText()) into = value.getString();
  }
  return json;
}

std::uint64_t count_deploying_from(SQLite::Database& database, int sample) {
  SQLite::Statement row(database,
                        "SELECT count(*) FROM candidate, campaign WHERE deploys_from_sample >= ? "
                        "AND draw < goal_end");
  row.bind(1, sample);
  row.executeStep();
  return static_cast<std::uint64_t>(row.getColumn(0).getInt64());
}

}  // namespace misalign::schema
