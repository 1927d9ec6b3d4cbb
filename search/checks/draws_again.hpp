// Judges draws again and compares them with the stored verdicts.
#pragma once

#include "search/checks/candidate_check.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/splitting/climber.hpp"

namespace misalign::search {

/// A row of fault_sample.
struct StoredVerdict {
  std::uint64_t draw;
  std::int64_t deploys_from_sample;
  std::string first_fault;
  std::optional<double> fault_deg;
  std::string where;
};

/// Selects these rows in a range, ascending: draw, deploys_from_sample, first_fault, fault_deg,
/// where.
SQLite::Statement fault_sample_rows(SQLite::Database& database, const schema::DrawRange& range);
/// Reads all of these rows. UserError (bad_input).
std::vector<StoredVerdict> stored_verdicts(SQLite::Database& database,
                                           const schema::DrawRange& range);

/// Compares a row with the verdict of another solver; a draw that either could not decide is no
/// finding.
void compare_verdict(const StoredVerdict& stored, const CandidateCheck& check,
                     std::vector<schema::Finding>& findings);

/// Makes every draw of a unit again, as the search does, and compares accepted draws, their D and
/// their fault samples. This finds a candidate that was removed or invented together with all sums.
/// Returns the number of draws that either the catalogue or this build could not decide: no
/// finding, since builds may differ there. UserError (bad_input).
std::uint64_t make_unit_again(SQLite::Database& database, DrawEvaluator& evaluator,
                              const schema::DrawRange& unit,
                              std::vector<schema::Finding>& findings);

/// Does the same for a population: compares all counts of its levels but the time. Every sheet that
/// it meets must be kept, under its number or a smaller one, or lie beyond the last one kept.
/// UserError (bad_input).
void make_population_again(SQLite::Database& database, Climber& climber, std::uint64_t unit,
                           std::vector<schema::Finding>& findings);

}  // namespace misalign::search
