// Finds where miscut copies of sheets stop whose filling is made for the sheet itself, and their
// shapes there.
#pragma once

#include "schema/campaign/campaign.hpp"
#include "solver/lanes/batch.hpp"
#include "solver/play/miscut_stops.hpp"
#include "solver/sheet/sheet.hpp"
#include "solver/target/shape_measure.hpp"

namespace misalign::search {

/// The filling of a sheet. UserError (bad_request) where its path ends before the rest.
solver::Filling filling_made_for(const solver::Sheet& sheet, const solver::Fill& fill);

/// The stops of some sheets, numbered from 0, and of their copies.
class CopyStops {
 public:
  /// Campaign and model must outlive this object. Copies are let go at the campaign's threshold.
  CopyStops(const schema::Campaign& campaign, const solver::Model& model,
            const std::optional<solver::Fill>& fill, double friction_n_mm_per_mm)
      : campaign_(campaign),
        model_(model),
        fill_(fill),
        friction_n_mm_per_mm_(friction_n_mm_per_mm) {}

  /// Makes the filling, if there is one, of the next sheet, and returns the sheet's stop. UserError
  /// as above.
  std::optional<solver::Stop> add(solver::SheetSolver& solver, const Eigen::Matrix2Xd& shifts_mm);
  /// Returns whether copies of a sheet can stop: it stops itself, or was to.
  bool has_some(std::size_t sheet) const { return sheet < sheets_.size() && sheets_[sheet].stops; }
  /// The stops of its copies, whose histories have lengths.
  solver::MiscutStops of(std::size_t sheet, const solver::ShiftBlock& copies,
                         const std::vector<solver::FoldingHistory>& histories,
                         solver::SheetSolver& solver) const;

 private:
  struct Filled {
    solver::Filling filling;
    bool stops;
  };

  std::optional<solver::Stop> stop_of(solver::SheetSolver& solver,
                                      const Eigen::Matrix2Xd& shifts_mm,
                                      const solver::FoldingHistory& history,
                                      const solver::Filling& filling) const;

  const schema::Campaign& campaign_;
  const solver::Model& model_;
  const std::optional<solver::Fill> fill_;
  const double friction_n_mm_per_mm_;
  std::vector<Filled> sheets_;
  std::optional<solver::ShapeMeasure> measure_;  // of the campaign's target
};

}  // namespace misalign::search
