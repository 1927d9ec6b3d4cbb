// Studies of a sheet that throw a UserError where there is no value.
#pragma once

#include <optional>
#include <string>

#include "schema/exchange/bent_panels_json.hpp"
#include "schema/files/user_error.hpp"
#include "search/sheets/folding_model.hpp"
#include "solver/contact/contact.hpp"
#include "solver/motion/pin_friction.hpp"
#include "solver/motion/rubber.hpp"
#include "solver/optimise/construct.hpp"
#include "solver/optimise/cut_outs.hpp"
#include "solver/optimise/spring_choice.hpp"

namespace misalign::search {

/// A bad request for an option that does not fit. For a reason "`sheet`: why, so `consequence`;
/// what to do", with the reason's cause and advice, unless `advice` is given.
schema::UserError study_error(const solver::Obstacle& obstacle, const std::string& sheet,
                              const std::string& consequence, const std::string& advice = "");

template <typename T>
T value_or_throw(solver::StudyResult<T> result, const std::string& sheet,
                 const std::string& consequence) {
  if (!result) throw study_error(result.obstacle(), sheet, consequence);
  return *std::move(result);
}

solver::ContactStudy contact_of(const solver::Sheet& sheet, const solver::ContactOptions& options);

/// Springs of a design as bodies; none without a diameter.
std::optional<solver::SpringBodies> spring_bodies(const schema::Design& design,
                                                  std::optional<double> diameter_mm,
                                                  std::optional<double> end_mm = {});

/// Springs of this design on a sheet of its model, which has a station at the angle of use.
solver::Actuation actuated(const solver::Sheet& sheet, const schema::Design& design);

/// The plates of an actuation along the way; none where the filling is not plates.
std::optional<solver::RubberStudy> rubber_of(const solver::Sheet& sheet,
                                             const solver::Actuation& actuation);
/// Cut-outs chosen by hole for a design's plates, from its angle of use, or D. UserError
/// (bad_request) where the filling is not plates.
solver::CutOutChoice chosen_cut_outs(const solver::Sheet& sheet, const schema::Design& design);
/// Limits of chosen springs, as they are typed.
struct SpringChoiceInput {
  solver::SpringChoiceOptions options;
  std::vector<std::string> never_both;  ///< "A3-A9,A4-A8"
};
/// The best springs of a sheet of this design: its angle of use and its friction hold where none
/// is typed. UserError (bad_request): a pair that names no two diagonals.
solver::SpringChoice chosen_springs(const solver::Sheet& sheet, const schema::Design& design,
                                    const SpringChoiceInput& input);

/// The motion of the sheet after its release.
solver::DeploymentStudy deployed(const solver::Sheet& sheet, const solver::ReleaseOptions& options);

/// The pin friction that it overcomes; none where the design names no pins.
std::optional<solver::PinStudy> pins_of(const solver::Sheet& sheet,
                                        const solver::ReleaseOptions& deploying,
                                        const schema::Design& design);

/// The study of its bent panels, with advice.
schema::BentSheet bent_sheet(const solver::Sheet& sheet, const solver::ReleaseOptions& deploying,
                             const schema::Design& design);

/// Results of `misalign deploy`.
struct ReleasedSheet {
  solver::DeploymentStudy motion;
  std::optional<schema::BentSheet> bent;  ///< none with rigid panels
  std::optional<solver::PinStudy> pins;
};
ReleasedSheet released_sheet(const solver::Sheet& sheet, const solver::ReleaseOptions& options,
                             const schema::Design& design, bool bends);

/// The sheet of the parallel family of a base read from `path`, shifting its inner vertices alone
/// or (`rim`) all. UserError (bad_input) also for a base without the family, or whose holes leave
/// another number of degrees of freedom than one.
solver::ConstructStudy constructed(const schema::Pattern& base, const std::string& path, bool rim,
                                   const solver::ConstructOptions& options);

}  // namespace misalign::search
