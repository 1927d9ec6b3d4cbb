// Finds where miscut copies of sheets stop whose filling is made for the sheet itself, and their
// shapes there.
#pragma once

#include <functional>

#include "schema/campaign/campaign.hpp"
#include "solver/lanes/batch.hpp"
#include "solver/play/tolerance.hpp"
#include "solver/sheet/sheet.hpp"
#include "solver/target/shape_measure.hpp"

namespace misalign::search {

/// The filling of a sheet; none where its path ends before the rest, or preload excludes another
/// value of the springs.
std::optional<solver::Filling> filling_made_for(const solver::Sheet& sheet,
                                                const solver::Fill& fill);

/// A filling, and a friction, that stop copies.
struct ToleranceFilling {
  std::optional<solver::Fill> fill{};  ///< made for the sheet itself
  /// Dry friction of a sheet's creases, N mm/mm; empty: none.
  std::function<double(const solver::Sheet&)> friction{};
};

/// The filling and the friction of a design, which may be that of its film.
ToleranceFilling filled_by(const schema::Design& design, const solver::PerforatedSheet& base);

/// The stops of some sheets, numbered from 0, and of their copies.
class CopyStops {
 public:
  /// All must outlive this object. Copies are let go at the campaign's threshold.
  CopyStops(const schema::Campaign& campaign, const solver::Model& model,
            const ToleranceFilling& filled)
      : campaign_(campaign), model_(model), filled_(filled) {}

  /// Makes the filling, if there is one, of the next sheet, and sets what its study has of its
  /// stop. UserError (bad_request) where its path ends before the filling's rest.
  void add(solver::SheetSolver& solver, const Eigen::Matrix2Xd& shifts_mm,
           solver::Tolerance& tolerance);
  /// Returns whether copies of a sheet can stop: it stops itself, or was to.
  bool has_some(std::size_t sheet) const { return sheet < sheets_.size() && sheets_[sheet].stops; }
  /// The stops of its copies, whose histories have lengths.
  solver::MiscutStops of(std::size_t sheet, const solver::ShiftBlock& copies,
                         const std::vector<solver::FoldingHistory>& histories,
                         solver::SheetSolver& solver) const;

 private:
  struct Filled {
    solver::Filling filling;
    double friction_n_mm_per_mm;
    bool stops;
  };

  std::optional<solver::Stop> stop_of(solver::SheetSolver& solver,
                                      const Eigen::Matrix2Xd& shifts_mm,
                                      const solver::FoldingHistory& history,
                                      const solver::Filling& filling,
                                      double friction_n_mm_per_mm) const;

  const schema::Campaign& campaign_;
  const solver::Model& model_;
  const ToleranceFilling& filled_;
  std::vector<Filled> sheets_;
  std::optional<solver::ShapeMeasure> measure_;  // of the campaign's target
};

}  // namespace misalign::search
