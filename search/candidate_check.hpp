// One stored candidate against what its own displacements give: the path again by another solver,
// and the folded shapes by their coordinates.
#pragma once

#include "schema/ledger_check.hpp"
#include "search/column_tolerances.hpp"
#include "search/contact.hpp"
#include "solver/elimination.hpp"
#include "solver/fold_lines.hpp"
#include "solver/metrics.hpp"

namespace misalign::search {

struct CandidateReport {
  std::vector<schema::Finding> findings;
  /// Columns that differ, but were measured by another definition.
  std::vector<std::string> not_comparable;
  /// Over the samples up to D.
  solver::ShapeErrors shape;
  double diagonal_mm = 0;  ///< of the recomputed lengths against the coordinates
  std::optional<double> first_contact_deg;
  std::string contact;  ///< the two panels that cross there: "[2,3] and [4,3]"
};

class CandidateCheck {
 public:
  explicit CandidateCheck(const schema::Campaign& campaign);
  CandidateCheck(const CandidateCheck&) = delete;
  CandidateCheck& operator=(const CandidateCheck&) = delete;

  /// `row` is the candidate's row, see read_candidate, measured by this version of the metrics;
  /// what it lacks is a finding, and what has another meaning now is compared in vain at most.
  CandidateReport check(const schema::Json& row,
                        int metrics_version = solver::kMetricsVersion) const;

  /// The verdict on a draw, by the same solver.
  solver::Verdict verdict(std::uint64_t draw) const;
  const schema::Campaign& campaign() const { return campaign_; }
  const solver::Mechanism& mechanism() const { return mechanism_; }

 private:
  void check_metrics(const schema::Json& row, int metrics_version, const solver::Metrics& metrics,
                     CandidateReport& report) const;
  Eigen::Matrix2Xd shifts_mm(std::uint64_t draw) const;
  void check_shapes(const std::string& where, const solver::FlatVertices& vertices_mm,
                    const solver::FoldingHistory& history,
                    const std::vector<solver::FoldState<double>>& states,
                    CandidateReport& report) const;
  void add_shape_findings(const std::string& where, CandidateReport& report) const;

  const schema::Campaign& campaign_;
  const solver::Mechanism mechanism_;
  const solver::Elimination elimination_;
  const solver::PathPlan plan_;
  const ColumnTolerances tolerances_;
  const solver::FoldedShape shape_;
  const solver::Panels panels_;
};

}  // namespace misalign::search
