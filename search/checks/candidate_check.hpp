// One stored candidate against what its own displacements give: the path again by another solver,
// and the folded shapes by their coordinates.
#pragma once

#include <memory>

#include "search/checks/folded_check.hpp"
#include "solver/design/optimise.hpp"
#include "solver/records/metrics.hpp"

namespace misalign::search {

/// Whether a value of an ascent is stored, but for its last digits, which differ between machines;
/// or none of both.
bool is_stored(const schema::Json& stored, const std::optional<double>& worth);

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

  /// Of an optimising search also how it came from its draw: that this is accepted, that the end
  /// keeps what is asked, and what both are worth. Of a population's sheets the end alone.
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
