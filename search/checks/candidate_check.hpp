// One stored candidate against what its own displacements give: the path again by another solver,
// and the folded shapes by their coordinates.
#pragma once

#include <functional>
#include <memory>

#include "schema/records/ascent_record.hpp"
#include "search/checks/folded_check.hpp"
#include "solver/optimise/optimise.hpp"
#include "solver/records/metrics.hpp"

namespace misalign::search {

/// A row of table `ascent`, but for its draw.
schema::Json ascent_row(const schema::AscentRecord& ascent);
/// Calls `differ` for each column of such a row that another one has not, but for the last digits
/// of values, which differ between machines. Rows may hold a draw, too.
void compare_ascents(const schema::Json& stored, const schema::Json& other,
                     const std::function<void(const std::string& column, const schema::Json& stored,
                                              const schema::Json& other)>& differ);

struct CandidateReport : ShapeReport {
  /// Columns that differ, but were measured by another definition.
  std::vector<std::string> not_comparable;
};

class CandidateCheck {
 public:
  explicit CandidateCheck(const schema::Campaign& campaign);
  CandidateCheck(const CandidateCheck&) = delete;
  CandidateCheck& operator=(const CandidateCheck&) = delete;

  /// `row` is the candidate's row, see read_candidate, measured by this version of the metrics;
  /// a value that it lacks is a finding; one whose definition changed since is not comparable.
  CandidateReport check(const schema::Json& row,
                        int metrics_version = solver::kMetricsVersion) const;

  /// Of an optimising search also how it came from its draw: that this is accepted, whether it can
  /// go on from there, that the end keeps what is asked, and what both are worth. Of a population's
  /// sheets the end alone.
  void check_ascent(const schema::Json& row, const schema::Json& ascent,
                    CandidateReport& report) const;

  /// The verdict on a draw, by the same solver.
  solver::Verdict verdict(std::uint64_t draw) const;
  const schema::Campaign& campaign() const { return campaign_; }
  const solver::Mechanism& mechanism() const { return sheets_.mechanism(); }

 private:
  void check_metrics(const schema::Json& row, int metrics_version, const solver::Metrics& metrics,
                     CandidateReport& report) const;

  const schema::Campaign& campaign_;
  const FoldedCheck sheets_;
  // Of an optimising search: what is asked, and sheets up to its threshold.
  std::optional<solver::OptimiseOptions> asked_;
  std::unique_ptr<const solver::Model> model_;
};

}  // namespace misalign::search
