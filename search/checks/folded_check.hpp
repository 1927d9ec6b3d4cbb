// Checks the folded shapes of a sheet by their coordinates alone.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "schema/catalogue/ledger_check.hpp"
#include "schema/exchange/contact_json.hpp"
#include "search/checks/column_tolerances.hpp"
#include "search/checks/crossing_check.hpp"
#include "search/sheets/folding_model.hpp"
#include "solver/model/panels.hpp"
#include "solver/records/history.hpp"

namespace misalign::search {

struct ShapeReport {
  std::vector<schema::Finding> findings;
  /// Largest errors over the samples checked.
  solver::ShapeCheck::Errors shape;
  double diagonal_mm = 0;  ///< error of the recomputed lengths against the coordinates
  std::optional<double> first_contact_deg;
  std::string contact;  ///< the two panels that cross there: "[2,3] and [4,3]"
  /// First contact of panels at any angle up to the last of those samples, as contact_json; null
  /// without one. `met_until_deg` is the angle up to which that is known.
  schema::Json meet;
  double met_until_deg = 0;
  std::string meet_text;  ///< "panels [2,3] and [4,3] first meet at 171.2345 deg", or that none do
};

/// Writes a line for each finding; beyond schema::kMostListed their number.
std::string findings_text(const std::vector<schema::Finding>& findings);
/// Writes the findings' details, each with its "sentence".
schema::Json findings_json(const std::vector<schema::Finding>& findings);
/// Writes the line for no crossing: no panels cross, or this build cannot check it.
std::string no_contacts_text();
/// Writes "length 1.2e-13 mm, planarity ...".
std::string worst_text(const solver::ShapeCheck::Errors& shape, double diagonal_mm);
schema::Json worst_json(const solver::ShapeCheck::Errors& shape, double diagonal_mm);

class FoldedCheck {
 public:
  /// `base` must outlive this object.
  FoldedCheck(const schema::Pattern& base, const schema::Sampling& sampling);
  /// Checks a campaign's draws; `campaign` must outlive this object.
  explicit FoldedCheck(const schema::Campaign& campaign);
  FoldedCheck(const FoldedCheck&) = delete;
  FoldedCheck& operator=(const FoldedCheck&) = delete;

  /// Returns the sheet with these shifts, one column per vertex.
  solver::Sheet sheet(const Eigen::Matrix2Xd& shifts_mm) const { return model_->sheet(shifts_mm); }
  /// Checks the first `samples` folded shapes: panels are rigid, creases and diagonals agree with
  /// the history. Also reports where panels first cross, if this build can check it; that is no
  /// fault. `where` names the sheet.
  void check_shapes(const std::string& where, const solver::Sheet& sheet, Eigen::Index samples,
                    ShapeReport& report) const;

  const solver::Mechanism& mechanism() const { return model_->mechanism(); }
  const ColumnTolerances& tolerances() const { return tolerances_; }

 private:
  /// Does nothing without FCL.
  void find_crossing(const solver::Sheet& sheet, Eigen::Index samples, ShapeReport& report) const;
  void find_meeting(const solver::Sheet& sheet, Eigen::Index samples, ShapeReport& report) const;
  void add_shape_findings(const std::string& where, const solver::Panels& panels,
                          ShapeReport& report) const;

  const std::unique_ptr<FoldingModel> model_;
  const ColumnTolerances tolerances_;
};

}  // namespace misalign::search
