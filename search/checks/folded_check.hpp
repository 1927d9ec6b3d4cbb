// A sheet followed again, and its folded shapes judged by their coordinates alone.
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
  /// Over the samples that were looked at.
  solver::ShapeCheck::Errors shape;
  double diagonal_mm = 0;  ///< of the recomputed lengths against the coordinates
  std::optional<double> first_contact_deg;
  std::string contact;  ///< the two panels that cross there: "[2,3] and [4,3]"
  /// Where panels first meet at any angle up to the last of those samples, as contact_json; null if
  /// they do not, and how far that is known.
  schema::Json meet;
  double met_until_deg = 0;
  std::string meet_text;  ///< "panels [2,3] and [4,3] meet first at 171.2345 deg", or that none do
};

/// A line for each finding, printable; beyond schema::kMostListed their number.
std::string findings_text(const std::vector<schema::Finding>& findings);
/// Their details, each with its "sentence".
schema::Json findings_json(const std::vector<schema::Finding>& findings);
/// A line where no panels were found to cross: that none do, or that this build cannot tell.
std::string no_contacts_text();
/// "length 1.2e-13 mm, planarity ..."
std::string worst_text(const solver::ShapeCheck::Errors& shape, double diagonal_mm);
schema::Json worst_json(const solver::ShapeCheck::Errors& shape, double diagonal_mm);

class FoldedCheck {
 public:
  /// `base` must outlive this object.
  FoldedCheck(const schema::Pattern& base, const schema::Sampling& sampling);
  /// Of a campaign's draws; it must outlive this object.
  explicit FoldedCheck(const schema::Campaign& campaign);
  FoldedCheck(const FoldedCheck&) = delete;
  FoldedCheck& operator=(const FoldedCheck&) = delete;

  /// With these shifts, one column per vertex.
  solver::Sheet sheet(const Eigen::Matrix2Xd& shifts_mm) const { return model_->sheet(shifts_mm); }
  /// The first `samples` folded shapes: rigid panels, creases and diagonals as the history says;
  /// and where panels first cross, if this build can tell, which is no fault. `where` names the
  /// sheet.
  void check_shapes(const std::string& where, const solver::Sheet& sheet, Eigen::Index samples,
                    ShapeReport& report) const;

  const solver::Mechanism& mechanism() const { return model_->mechanism(); }
  const ColumnTolerances& tolerances() const { return tolerances_; }

 private:
  /// Nothing where this build is without FCL.
  void find_crossing(const solver::Sheet& sheet, Eigen::Index samples, ShapeReport& report) const;
  void find_meeting(const solver::Sheet& sheet, Eigen::Index samples, ShapeReport& report) const;
  void add_shape_findings(const std::string& where, const solver::Panels& panels,
                          ShapeReport& report) const;

  const std::unique_ptr<FoldingModel> model_;
  const ColumnTolerances tolerances_;
};

}  // namespace misalign::search
