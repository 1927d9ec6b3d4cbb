// Checks a stored candidate against its displacements: the path by another solver, and the folded
// shapes by their coordinates.
#pragma once

#include <functional>
#include <memory>

#include "schema/records/ascent_record.hpp"
#include "search/checks/folded_check.hpp"
#include "solver/optimise/optimise.hpp"
#include "solver/records/metrics.hpp"

namespace misalign::search {

/// Writes a row of table `ascent`, without its draw.
schema::Json ascent_row(const schema::AscentRecord& ascent);
/// Calls `differ` for each column in which two such rows differ. The last digits of values may
/// differ between machines. Rows may hold a draw, too.
void compare_ascents(const schema::Json& stored, const schema::Json& other,
                     const std::function<void(const std::string& column, const schema::Json& stored,
                                              const schema::Json& other)>& differ);

struct CandidateReport : ShapeReport {
  /// Columns that differ because they were measured by another definition.
  std::vector<std::string> not_comparable;
};

class CandidateCheck {
 public:
  explicit CandidateCheck(const schema::Campaign& campaign);
  CandidateCheck(const CandidateCheck&) = delete;
  CandidateCheck& operator=(const CandidateCheck&) = delete;

  /// Checks the candidate's row, see read_candidate, measured by this version of the metrics. A
  /// missing value is a finding; a value whose definition has changed is not comparable.
  CandidateReport check(const schema::Json& row,
                        int metrics_version = solver::kMetricsVersion) const;

  /// Checks an optimising search's ascent: the draw is accepted, it can start there, and the values
  /// of start and optimum are right. For a population's sheets it checks the optimum alone; for a
  /// search among sheets of one shape the distances of start and end.
  void check_ascent(const schema::Json& row, const schema::Json& ascent,
                    CandidateReport& report) const;

  /// Judges a draw by the same solver.
  solver::Verdict verdict(std::uint64_t draw) const;
  const schema::Campaign& campaign() const { return campaign_; }
  const solver::Mechanism& mechanism() const { return sheets_.mechanism(); }

 private:
  void check_metrics(const schema::Json& row, int metrics_version, const solver::Metrics& metrics,
                     CandidateReport& report) const;

  const schema::Campaign& campaign_;
  const FoldedCheck sheets_;
  // Objective of an optimising search, and model of one with ends, up to its threshold.
  std::optional<solver::OptimiseOptions> asked_;
  std::unique_ptr<const solver::Model> model_;
};

}  // namespace misalign::search
