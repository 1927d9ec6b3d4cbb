// A pattern's or a campaign's model, made ready once, with the solver of its sheets and its design.
#pragma once

#include <string>
#include <vector>

#include "schema/exchange/folding_json.hpp"
#include "search/draws/models.hpp"
#include "solver/motion/actuation.hpp"
#include "solver/target/shape_measure.hpp"

namespace misalign::search {

class FoldingModel {
 public:
  /// `base` must outlive this object; its own shifts do not matter. UserError where the design
  /// names springs that the sheet has not.
  FoldingModel(const schema::Pattern& base, const schema::Sampling& sampling,
               const schema::Design& design, const StationOptions& stations = {});
  /// A campaign's, with its design.
  explicit FoldingModel(const schema::Campaign& campaign, const StationOptions& stations = {});

  /// The sheet with these shifts, one column per vertex; it refers to this object.
  solver::Sheet sheet(const Eigen::Matrix2Xd& shifts_mm, const std::string& name = "the sheet") {
    return {solver_, shifts_mm, name};
  }

  /// The distances of its sheets from a wanted shape; none where the base does not fold to it.
  std::optional<solver::ShapeMeasure> measure(const solver::WantedShape& shape, double at_deg) {
    return solver::ShapeMeasure::of(solver_, shape, at_deg);
  }

  const schema::Pattern& base() const { return base_; }
  const schema::Sampling& sampling() const { return sampling_; }
  const schema::Design& design() const { return design_; }
  solver::Actuators actuators() const { return design_.actuators(base_.base); }
  const solver::Mechanism& mechanism() const { return model_.mechanism(); }

 private:
  const schema::Pattern& base_;
  const schema::Sampling sampling_;
  const schema::Design design_;
  const solver::Model model_;
  solver::SheetSolver solver_;
};

/// UserError (check_failed) if the shapes of these rows are not the flat sheet's panels, folded as
/// the history says: judged by coordinates alone.
void check_shapes(const solver::Sheet& sheet, const std::vector<Eigen::Index>& rows);

}  // namespace misalign::search
