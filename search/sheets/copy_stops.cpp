#include "search/sheets/copy_stops.hpp"

#include <fmt/format.h>

#include "schema/pattern/target.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/shaped.hpp"
#include "solver/motion/deploy.hpp"
#include "solver/sheet/sheet_filling.hpp"

namespace misalign::search {

std::optional<solver::Filling> filling_made_for(const solver::Sheet& sheet,
                                                const solver::Fill& fill) {
  if (solver::preload_fault(fill)) return {};
  const double end_deg = sheet.way() ? sheet.way()->end_deg() : 0;
  if (!solver::is_relaxed_flat(fill) && end_deg < solver::rest_deg(fill)) return {};
  return solver::filling_of(sheet, fill);
}

ToleranceFilling filled_by(const schema::Design& design, const solver::PerforatedSheet& base) {
  return {design.fill(base), [design](const solver::Sheet& sheet) {
            return hinge_friction_n_mm_per_mm(design, sheet);
          }};
}

void CopyStops::add(solver::SheetSolver& solver, const Eigen::Matrix2Xd& shifts_mm,
                    solver::Tolerance& tolerance) {
  if (!filled_.fill) return;
  const solver::Fill& fill = *filled_.fill;
  const double rest_deg = solver::rest_deg(fill);
  if (campaign_.target && !measure_) {
    const auto rests_at = rest_deg > 0 ? std::optional(rest_deg) : std::nullopt;
    measure_ = solver::ShapeMeasure::of(solver, campaign_.target->shape,
                                        shape_deg(*campaign_.target, rests_at));
  }
  const solver::Sheet sheet(solver, shifts_mm);
  const auto filling = filling_made_for(sheet, fill);
  if (!filling && rest_deg > 0) {
    if (const auto fault = solver::preload_fault(fill)) throw schema::UserError(*fault);
    throw schema::UserError(
        solver::OptionFault{"rest_deg", schema::shown_number(rest_deg),
                            fmt::format("lies beyond the end of a sheet's path, {:.6g} deg",
                                        sheet.way() ? sheet.way()->end_deg() : 0),
                            "name a smaller angle"});
  }
  const double friction = filled_.friction ? filled_.friction(sheet) : 0;
  sheets_.push_back({filling.value_or(solver::Filling()), friction, false});
  if (!filling) return;
  // Friction alone, short of flat, is no stop.
  const auto relaxed_deg =
      solver::stop_deg(solver::driven_stations(sheet.history(), *filling), campaign_.threshold_deg);
  sheets_.back().stops = rest_deg > 0 || relaxed_deg.value_or(0) > 0;
  if (!sheets_.back().stops) return;
  tolerance.rest_deg = rest_deg;
  tolerance.friction_n_mm_per_mm = friction;
  tolerance.has_shapes = measure_.has_value();
  tolerance.own_stop = stop_of(solver, shifts_mm, sheet.history(), *filling, friction);
}

std::optional<solver::Stop> CopyStops::stop_of(solver::SheetSolver& solver,
                                               const Eigen::Matrix2Xd& shifts_mm,
                                               const solver::FoldingHistory& history,
                                               const solver::Filling& filling,
                                               double friction_n_mm_per_mm) const {
  auto stop = solver::stop_of(history, filling, campaign_.threshold_deg, friction_n_mm_per_mm);
  if (!stop || stop->at_deg == 0 || !measure_) return stop;
  const solver::Sheet sheet(solver, shifts_mm);
  if (!sheet.way() || sheet.way()->end_deg() < stop->at_deg) return {};
  const solver::ShapeMisfit misfit = measure_->fitted(sheet.at(stop->at_deg).vertices_mm);
  stop->shape_rms_mm = misfit.rms_mm();
  stop->shape_max_mm = misfit.max_mm();
  return stop;
}

solver::MiscutStops CopyStops::of(std::size_t sheet, const solver::ShiftBlock& copies,
                                  const std::vector<solver::FoldingHistory>& histories,
                                  solver::SheetSolver& solver) const {
  const solver::Mechanism& mechanism = model_.mechanism();
  const Filled& filled = sheets_[sheet];
  solver::MiscutStops stops;
  for (int k = 0; k < copies.sheets; ++k) {
    const Eigen::Matrix2Xd shifts_mm =
        Eigen::Map<const Eigen::Matrix2Xd>(copies.of(k), 2, mechanism.vertices);
    const solver::Filling in_copy = filled.filling.in_holes(solver::diagonal_products_mm2(
        mechanism, campaign_.pattern.base.sheet.vertices_mm + shifts_mm));
    stops.add(stop_of(solver, shifts_mm, histories[static_cast<std::size_t>(k)], in_copy,
                      filled.friction_n_mm_per_mm));
  }
  return stops;
}

}  // namespace misalign::search
