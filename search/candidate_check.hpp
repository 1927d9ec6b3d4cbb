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

  /// `row` is the candidate's row, see read_candidate, with the columns of this schema filled; what
  /// it lacks is a finding.
  CandidateReport check(const schema::Json& row, int schema_version = schema::kSchemaVersion) const;

 private:
  void check_metrics(const schema::Json& row, int schema_version, const solver::Metrics& metrics,
                     CandidateReport& report) const;
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
