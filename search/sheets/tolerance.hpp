// `misalign tolerance`: judges copies of a sheet with every vertex cut a little off its place.
#pragma once

#include <functional>

#include "search/draws/draw_evaluator.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/copy_stops.hpp"
#include "solver/play/tolerance.hpp"

namespace misalign::search {

/// Errors of trial t, mm: x and y of every vertex of the sheet, uniform on [-amplitude, amplitude].
/// The same for every sheet of a campaign: stream 1 of the draws' generator, with t in the draw's
/// place.
void trial_errors(const schema::Campaign& campaign, double amplitude_mm, std::uint64_t trial,
                  double* errors_mm);

/// The number of judged copies, and of all.
struct CopiesDone {
  std::uint64_t done, all;
};
/// Shows them as the work under way.
void show_copies(const CopiesDone& copies);

struct ToleranceOptions {
  double amplitude_mm = 0;
  std::uint64_t trials = 1000;   ///< copies with errors at every vertex; 0: only the sheet's D
  bool vertices = false;         ///< also copies with an error at one vertex
  int jobs = 1;                  ///< threads; the answer does not depend on them
  solver::InstructionSet set{};  ///< nor on this
  /// Copies are asked for their stops where it stops the sheet short of flat, and for their shapes
  /// there if the campaign has a target.
  ToleranceFilling filled{};
  std::function<void(const CopiesDone&)> progress{};  ///< called now and then, one call at a time
};

/// The largest number of trials with one vertex alone.
inline constexpr std::uint64_t kMostTrialsOfOneVertex = 200;

/// UserError (bad_request) unless an amplitude is below that of this sheet.
void check_miscut(double amplitude_mm, const solver::CreasePattern& base,
                  const Eigen::Matrix2Xd& shifts_mm, const std::string& sheet);

/// The campaign with this angle as the threshold of copies.
/// UserError (bad_request) where it is no sample, or lies beyond D of a sheet, which `name_of`
/// names.
schema::Campaign used_from(const schema::Campaign& campaign, double from_deg,
                           const std::vector<Eigen::Matrix2Xd>& shifts_mm,
                           const ToleranceOptions& options,
                           const std::function<std::string(std::size_t)>& name_of);

/// The tolerance of one sheet, whose copies must deploy from this angle, or from its D. UserError
/// (bad_request) as above, and where the sheet does not deploy.
solver::Tolerance study_sheet(const ChosenSheet& sheet, std::optional<double> from_deg,
                              const ToleranceOptions& options);

/// One answer for each sheet of the campaign with these shifts; the amplitude is below the largest
/// of each. UserError (bad_request) where a sheet's path ends before its stop.
std::vector<solver::Tolerance> study_tolerance(const schema::Campaign& campaign,
                                               const std::vector<Eigen::Matrix2Xd>& shifts_mm,
                                               const ToleranceOptions& options);

}  // namespace misalign::search
