#include "schema/catalogue/unit_writer.hpp"

#include <cmath>
#include <optional>

#include "schema/catalogue/candidate_row.hpp"
#include "schema/catalogue/certificate_row.hpp"
#include "schema/catalogue/database.hpp"
#include "schema/catalogue/digest.hpp"
#include "schema/catalogue/population_rows.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "schema/records/fault_sample.hpp"

namespace misalign::schema {
namespace {

// Nine decimals: 1e-9 of a length of 100 mm is below what any maker can cut.
Json elongations_json(const std::vector<double>& elongation) {
  Json list = Json::array();
  for (const double e : elongation) list.push_back(std::round(e * 1e9) / 1e9);
  return list;
}

void bind_sum(SQLite::Statement& statement, int column, const CandidateSum& sum) {
  const auto bytes = sum.bytes();
  statement.bind(column, bytes.data(), static_cast<int>(bytes.size()));
}

template <class Value>
void bind_or_null(SQLite::Statement& statement, int column, const std::optional<Value>& value) {
  value ? statement.bind(column, *value) : statement.bind(column);
}

// Its values in the order in which write_candidate binds them.
std::string insert_of_candidates() {
  std::string columns = "draw, unit, displacements_mm, elongation", values = "?,?,?,?";
  for (const MetricEntry& metric : metric_table()) {
    columns += std::string(", ") + metric.name;
    values += ",?";
  }
  return "INSERT INTO candidate (" + columns + ") VALUES (" + values + ")";
}

// Runs it and makes it ready for the next row.
void insert(SQLite::Statement& statement) {
  statement.exec();
  statement.reset();
}

}  // namespace

UnitWriter::UnitWriter(SQLite::Database& database, const Campaign& campaign,
                       const solver::Mechanism& mechanism)
    : database_(database),
      campaign_(campaign),
      mechanism_(mechanism),
      unit_(database,
            "INSERT INTO unit (lo, hi, run, worker, accepted, rejected, undecided, seconds, "
            "digest_part) VALUES (?,?,?,?,?,?,?,?,?)"),
      candidate_(database, insert_of_candidates()),
      undecided_(database, "INSERT INTO undecided (draw, unit, cause, run) VALUES (?,?,?,?)"),
      fault_sample_(database,
                    "INSERT INTO fault_sample (draw, unit, deploys_from_sample, first_fault, "
                    "fault_deg, \"where\", stands_for) VALUES (?,?,?,?,?,?,?)"),
      screened_(database, kAddScreened),
      level_(database,
             "INSERT INTO population (unit, level, particles, survivors, ancestors, tried, taken, "
             "undecided, met, seconds) VALUES (?,?,?,?,?,?,?,?,?,?)"),
      sheet_(database, "INSERT INTO sheet (draw, hash) VALUES (?,?)"),
      ascent_(database,
              "INSERT INTO ascent (draw, start_value, end_value, steps, sheets_folded, ended, "
              "limited_by) VALUES (?,?,?,?,?,?,?)") {}

// What was screened is summed up first: a unit alone touches some two hundred rows of it.
void UnitWriter::write(const std::vector<UnitRecord>& units, std::int64_t run) {
  Screened screened;
  for (const UnitRecord& unit : units) {
    write_unit(unit, run);
    for (const auto& [seen, draws] : unit.screened) screened[seen] += draws;
  }
  add_screened(screened);
}

void UnitWriter::write_unit(const UnitRecord& unit, std::int64_t run) {
  const std::int64_t lo = stored(unit.range.lo);
  unit_.tryReset();
  unit_.bind(1, lo);
  unit_.bind(2, stored(unit.range.hi));
  unit_.bind(3, run);
  unit_.bind(4, unit.worker);
  unit_.bind(5, stored(unit.accepted));
  unit_.bind(6, stored(unit.rejected));
  unit_.bind(7, stored(unit.undecided.size()));
  unit_.bind(8, unit.seconds);
  bind_sum(unit_, 9, sum_of(unit));
  insert(unit_);
  for (const Candidate& candidate : unit.candidates) write_candidate(candidate, lo);
  for (const DrawVerdict& draw : unit.undecided) write_undecided(draw, lo, run);
  for (const DrawVerdict& sampled : unit.fault_sample) {
    write_fault_sample(sampled, lo, stored(FaultSampleRule().spacing(sampled.draw)));
  }
  for (const LevelCount& level : unit.levels) write_level(level, lo);
  if (!campaign_.search.splitting) return;
  keep_each_sheet_once(database_, campaign_, mechanism_, unit.range);
  drop_pieces(database_, static_cast<std::uint32_t>(unit.range.lo / kNumbersOfPopulation));
}

CandidateSum UnitWriter::sum_of(const UnitRecord& unit) const {
  CandidateSum sum = sum_of_levels(unit.range.lo, unit.levels);
  for (const Candidate& c : unit.candidates) {
    sum.add(
        c.draw, c.metrics.deploys_from_sample,
        campaign_.search.stores_sheets() ? sheet_hash(displacements_json(c.shifts_mm).dump()) : "");
  }
  return sum;
}

void UnitWriter::write_level(const LevelCount& level, std::int64_t unit) {
  level_.tryReset();
  int column = 0;
  level_.bind(++column, unit);
  for (const std::uint64_t count :
       {std::uint64_t{level.level}, std::uint64_t{level.particles}, std::uint64_t{level.survivors},
        std::uint64_t{level.ancestors}, level.tried, level.taken, level.undecided, level.met}) {
    level_.bind(++column, stored(count));
  }
  level_.bind(++column, level.seconds);
  insert(level_);
}

void UnitWriter::settle(const UnitRecord& decided) {
  const std::int64_t draw = stored(decided.range.lo);
  SQLite::Statement held(database_,
                         "SELECT unit.lo, digest_part FROM undecided JOIN unit ON unit.lo = unit "
                         "WHERE draw = ?");
  held.bind(1, draw);
  if (!held.executeStep() || held.getColumn(1).getBytes() != 16) {
    throw damaged(database_,
                  "draw " + std::to_string(decided.range.lo) + " is undecided in no unit");
  }
  const std::int64_t lo = held.getColumn(0).getInt64();
  CandidateSum sum =
      CandidateSum::from_bytes(static_cast<const unsigned char*>(held.getColumn(1).getBlob()));
  sum.add(sum_of(decided));
  SQLite::Statement row(database_, "SELECT stands_for FROM fault_sample WHERE draw = ?");
  row.bind(1, draw);
  std::optional<std::int64_t> stands_for;
  if (row.executeStep()) stands_for = row.getColumn(0).getInt64();
  for (const char* table : {"undecided", "fault_sample"}) {
    SQLite::Statement remove(database_, std::string("DELETE FROM ") + table + " WHERE draw = ?");
    remove.bind(1, draw);
    remove.exec();
  }
  SQLite::Statement update(database_,
                           "UPDATE unit SET undecided = undecided - 1, accepted = accepted + ?, "
                           "rejected = rejected + ?, digest_part = ? WHERE lo = ?");
  update.bind(1, stored(decided.accepted));
  update.bind(2, stored(decided.rejected));
  bind_sum(update, 3, sum);
  update.bind(4, lo);
  update.exec();
  for (const Candidate& candidate : decided.candidates) write_candidate(candidate, lo);
  for (const DrawVerdict& sampled : decided.fault_sample) {
    if (stands_for) write_fault_sample(sampled, lo, *stands_for);
  }
  add_screened(decided.screened);
}

void UnitWriter::write_candidate(const Candidate& candidate, std::int64_t unit) {
  candidate_.tryReset();
  int column = 0;
  candidate_.bind(++column, stored(candidate.draw));
  candidate_.bind(++column, unit);
  const std::string displacements_mm = displacements_json(candidate.shifts_mm).dump();
  candidate_.bind(++column, displacements_mm);
  candidate_.bind(++column, elongations_json(candidate.metrics.elongation).dump());
  each_metric(candidate.metrics, [&](const MetricEntry&, const auto& value) {
    if constexpr (requires { value.has_value(); }) {
      bind_or_null(candidate_, ++column, value);
    } else {
      candidate_.bind(++column, value);
    }
  });
  insert(candidate_);
  if (candidate.certificate) write_certificates(database_, {*candidate.certificate});
  if (candidate.ascent) write_ascent(*candidate.ascent, candidate.draw);
  if (!campaign_.search.stores_sheets()) return;
  const std::string hash = sheet_hash(displacements_mm);
  sheet_.tryReset();
  sheet_.bind(1, stored(candidate.draw));
  sheet_.bind(2, hash.data(), static_cast<int>(hash.size()));
  insert(sheet_);
}

void UnitWriter::write_ascent(const AscentRecord& ascent, std::uint64_t draw) {
  ascent_.tryReset();
  ascent_.bind(1, stored(draw));
  bind_or_null(ascent_, 2, ascent.start_value);
  bind_or_null(ascent_, 3, ascent.end_value);
  ascent_.bind(4, ascent.steps);
  ascent_.bind(5, ascent.sheets_folded);
  ascent_.bind(6, ascent.ended);
  bind_or_null(ascent_, 7, ascent.limited_by);
  insert(ascent_);
}

void UnitWriter::write_undecided(const DrawVerdict& draw, std::int64_t unit, std::int64_t run) {
  undecided_.tryReset();
  undecided_.bind(1, stored(draw.draw));
  undecided_.bind(2, unit);
  undecided_.bind(3, undecided_cause(draw.verdict));
  undecided_.bind(4, run);
  insert(undecided_);
}

void UnitWriter::write_fault_sample(const DrawVerdict& draw, std::int64_t unit,
                                    std::int64_t stands_for) {
  const std::string where = where_label(mechanism_, draw.verdict);
  const int fault_sample = draw.verdict.fault_sample();
  fault_sample_.tryReset();
  fault_sample_.bind(1, stored(draw.draw));
  fault_sample_.bind(2, unit);
  fault_sample_.bind(3, draw.verdict.deploys_from_sample);
  fault_sample_.bind(4, solver::fault_name(draw.verdict.first_fault));
  fault_sample > 0 ? fault_sample_.bind(5, fault_sample * campaign_.sample_deg)
                   : fault_sample_.bind(5);
  where.empty() ? fault_sample_.bind(6) : fault_sample_.bind(6, where);
  fault_sample_.bind(7, stands_for);
  insert(fault_sample_);
}

void UnitWriter::add_screened(const Screened& screened) {
  for (const auto& [seen, draws] : screened) {
    screened_.tryReset();
    screened_.bind(1, solver::fault_name(static_cast<solver::Fault>(seen.first)));
    screened_.bind(2, seen.second * campaign_.sample_deg);
    screened_.bind(3, stored(draws));
    insert(screened_);
  }
}

}  // namespace misalign::schema
