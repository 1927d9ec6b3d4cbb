#include "schema/catalogue/unit_writer.hpp"

#include <cmath>
#include <optional>

#include "schema/catalogue/candidate_row.hpp"
#include "schema/catalogue/certificate_row.hpp"
#include "schema/catalogue/database.hpp"
#include "schema/catalogue/digest.hpp"
#include "schema/catalogue/population_rows.hpp"
#include "schema/catalogue/sheets_once.hpp"
#include "schema/files/json_values.hpp"
#include "schema/pattern/pattern_json.hpp"
#include "schema/records/fault_sample.hpp"

namespace misalign::schema {
namespace {

// Rounds to nine decimals: 1e-9 of a length of 100 mm is below any manufacturing accuracy.
Json elongations_json(const std::vector<double>& elongation) {
  return json_list(elongation, [](double e) { return std::round(e * 1e9) / 1e9; });
}

// Returns the INSERT of a candidate, with values in the order of write_candidate.
std::string insert_of_candidates() {
  std::string columns = "draw, unit, displacements_mm, elongation", values = "?,?,?,?";
  for (const MetricEntry& metric : metric_table()) {
    columns += std::string(", ") + metric.name;
    values += ",?";
  }
  return "INSERT INTO candidate (" + columns + ") VALUES (" + values + ")";
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

// Screened counts are summed up first: a single unit changes some two hundred of their rows.
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
  execute(unit_, lo, unit.range.hi, run, unit.worker, unit.accepted, unit.rejected,
          unit.undecided.size(), unit.seconds, Blob(sum_of(unit).bytes()));
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
  execute(level_, unit, level.level, level.particles, level.survivors, level.ancestors, level.tried,
          level.taken, level.undecided, level.met, level.seconds);
}

void UnitWriter::settle(const UnitRecord& decided) {
  const std::int64_t draw = stored(decided.range.lo);
  SQLite::Statement held =
      bound(database_,
            "SELECT unit.lo, digest_part FROM undecided JOIN unit ON unit.lo = unit "
            "WHERE draw = ?",
            draw);
  if (!held.executeStep() || held.getColumn(1).getBytes() != 16) {
    throw damaged(database_,
                  "draw " + std::to_string(decided.range.lo) + " is undecided in no unit");
  }
  const std::int64_t lo = held.getColumn(0).getInt64();
  CandidateSum sum =
      CandidateSum::from_bytes(static_cast<const unsigned char*>(held.getColumn(1).getBlob()));
  sum.add(sum_of(decided));
  SQLite::Statement row =
      bound(database_, "SELECT stands_for FROM fault_sample WHERE draw = ?", draw);
  std::optional<std::int64_t> stands_for;
  if (row.executeStep()) stands_for = row.getColumn(0).getInt64();
  for (const char* table : {"undecided", "fault_sample"}) {
    bound(database_, std::string("DELETE FROM ") + table + " WHERE draw = ?", draw).exec();
  }
  bound(database_,
        "UPDATE unit SET undecided = undecided - 1, accepted = accepted + ?, "
        "rejected = rejected + ?, digest_part = ? WHERE lo = ?",
        decided.accepted, decided.rejected, Blob(sum.bytes()), lo)
      .exec();
  for (const Candidate& candidate : decided.candidates) write_candidate(candidate, lo);
  for (const DrawVerdict& sampled : decided.fault_sample) {
    if (stands_for) write_fault_sample(sampled, lo, *stands_for);
  }
  add_screened(decided.screened);
}

void UnitWriter::write_candidate(const Candidate& candidate, std::int64_t unit) {
  const std::string displacements_mm = displacements_json(candidate.shifts_mm).dump();
  bind_all(candidate_, candidate.draw, unit, displacements_mm,
           elongations_json(candidate.metrics.elongation).dump());
  int column = 4;
  each_metric(candidate.metrics, [&](const MetricEntry&, const auto& value) {
    bind_value(candidate_, ++column, value);
  });
  candidate_.exec();
  candidate_.reset();
  if (candidate.certificate) write_certificates(database_, {*candidate.certificate});
  if (candidate.ascent) write_ascent(*candidate.ascent, candidate.draw);
  if (!campaign_.search.stores_sheets()) return;
  execute(sheet_, candidate.draw, Blob(sheet_hash(displacements_mm)));
}

void UnitWriter::write_ascent(const AscentRecord& ascent, std::uint64_t draw) {
  execute(ascent_, draw, ascent.start_value, ascent.end_value, ascent.steps, ascent.sheets_folded,
          ascent.ended, ascent.limited_by);
}

void UnitWriter::write_undecided(const DrawVerdict& draw, std::int64_t unit, std::int64_t run) {
  execute(undecided_, draw.draw, unit, undecided_cause(draw.verdict), run);
}

void UnitWriter::write_fault_sample(const DrawVerdict& draw, std::int64_t unit,
                                    std::int64_t stands_for) {
  const std::string where = where_label(mechanism_, draw.verdict);
  const int fault_sample = draw.verdict.fault_sample();
  execute(fault_sample_, draw.draw, unit, draw.verdict.deploys_from_sample,
          solver::fault_name(draw.verdict.first_fault),
          fault_sample > 0 ? std::optional(fault_sample * campaign_.sample_deg) : std::nullopt,
          where.empty() ? std::nullopt : std::optional(where), stands_for);
}

void UnitWriter::add_screened(const Screened& screened) {
  for (const auto& [seen, draws] : screened) {
    execute(screened_, solver::fault_name(static_cast<solver::Fault>(seen.first)),
            seen.second * campaign_.sample_deg, draws);
  }
}

}  // namespace misalign::schema
