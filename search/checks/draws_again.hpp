// Judges draws again and compares with the stored verdicts.
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

/// The same row, as it is read in this range, ascending: draw, deploys_from_sample, first_fault,
/// fault_deg, where.
SQLite::Statement fault_sample_rows(SQLite::Database& database, const schema::DrawRange& range);
/// All of those rows. UserError (bad_input).
std::vector<StoredVerdict> stored_verdicts(SQLite::Database& database,
                                           const schema::DrawRange& range);

/// Compares one with the verdict of another solver than the one that judged it; what either could
/// not decide is no finding.
void compare_verdict(const StoredVerdict& stored, const CandidateCheck& check,
                     std::vector<schema::Finding>& findings);

/// Makes every draw of a unit again, as the search does, and compares which are accepted, from
/// where they deploy, and their fault samples: it finds a candidate that was removed, or invented,
/// together with all sums. Returns how many draws are undecided in the catalogue or here, and
/// decided in the other: another build may know, so that is no finding. UserError (bad_input).
std::uint64_t make_unit_again(SQLite::Database& database, DrawEvaluator& evaluator,
                              const schema::DrawRange& unit,
                              std::vector<schema::Finding>& findings);

/// The same of a population: all counts of its levels but the time, and that every sheet it meets
/// is kept, under its number or a lesser one, or lies beyond the last that is. UserError
/// (bad_input).
void make_population_again(SQLite::Database& database, Climber& climber, std::uint64_t unit,
                           std::vector<schema::Finding>& findings);

}  // namespace misalign::search
