// Studies of a sheet that throw a UserError where there is no value.
#pragma once

#include <optional>
#include <string>

#include "schema/exchange/bent_panels_json.hpp"
#include "schema/files/user_error.hpp"
#include "search/sheets/folding_model.hpp"
#include "solver/contact/contact.hpp"
#include "solver/motion/pin_friction.hpp"
#include "solver/optimise/construct.hpp"

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

/// Springs of this design on a sheet of its model, which has a station at the angle of use.
solver::Actuation actuated(const solver::Sheet& sheet, const schema::Design& design);

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
