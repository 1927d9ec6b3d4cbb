// Studies of a sheet that throw a UserError where there is no value.
#pragma once

#include <optional>
#include <string>

#include "schema/exchange/bent_panels_json.hpp"
#include "schema/files/user_error.hpp"
#include "search/sheets/folding_model.hpp"
#include "solver/contact/contact.hpp"
#include "solver/contact/spring_faces.hpp"
#include "solver/fitting/cut_outs.hpp"
#include "solver/fitting/spring_choice.hpp"
#include "solver/motion/pin_friction.hpp"
#include "solver/motion/rubber.hpp"
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

/// Springs of a design as bodies; none where it gives no diameter, or its filling is no springs.
std::optional<solver::SpringBodies> spring_bodies(const schema::Design& design,
                                                  std::optional<double> end_mm = {});

/// The two diagonals of each hole.
std::vector<std::pair<int, int>> diagonals_of_one_hole(const solver::Mechanism& mechanism);

/// Options of contact from a design: its angle of use and its springs. UserError (bad_request)
/// where the springs' ends are given, and it has none with a diameter.
solver::ContactOptions contact_options(const schema::Design& design, std::optional<double> trim_mm,
                                       std::optional<double> end_mm = {});
/// Faces and layers of the design's springs in which none meet up to the angle of use. UserError
/// (bad_request) where it has no springs with a diameter.
solver::SpringFaces faces_of_springs(const solver::Sheet& sheet, const schema::Design& design,
                                     std::optional<double> end_mm);

solver::ContactStudy contact_of(const solver::Sheet& sheet, const solver::ContactOptions& options);
/// The same, with untrimmed corners if no edge would remain; none if the path is lost.
std::optional<solver::ContactStudy> known_contact(const solver::Sheet& sheet,
                                                  solver::ContactOptions options);

/// The filling of a design, with the pairs of springs that touch between flat and the angle of use,
/// or D. Springs have the design's diameter, or kSpringDiameter_mm. Where contact is not known the
/// pairs are the two of each hole.
solver::Actuators actuators_on(const solver::Sheet& sheet, const schema::Design& design,
                               std::optional<double> from_deg);

/// UserError (bad_request) where the filling stores no energy anywhere on the way.
void need_energy(const solver::Sheet& sheet, const solver::Fill& fill,
                 const std::string& consequence);

/// Springs of this design on a sheet of its model, which has a station at the angle of use.
solver::Actuation actuated(const solver::Sheet& sheet, const schema::Design& design);

/// The plates of an actuation along the way; none where the filling is not plates.
std::optional<solver::RubberStudy> rubber_of(const solver::Sheet& sheet,
                                             const solver::Actuation& actuation);
/// Cut-outs of plates chosen by hole, from this angle of use, or D.
solver::CutOutChoice chosen_cut_outs(const solver::Sheet& sheet, const solver::RubberPlates& plates,
                                     std::optional<double> from_deg);
/// Limits of chosen springs, as they are typed.
struct SpringChoiceInput {
  solver::SpringChoiceOptions options;
  std::vector<std::string> never_both;  ///< "A3-A9,A4-A8"
};
/// The best springs of a sheet of this design: its angle of use and its friction hold where none
/// is typed, and so do its wires and one spring a hole; of springs with a diameter no two touch.
/// UserError (bad_request): a pair that names no two diagonals.
solver::SpringChoice chosen_springs(const solver::Sheet& sheet, const schema::Design& design,
                                    const SpringChoiceInput& input);

/// The motion of the sheet after its release.
solver::DeploymentStudy deployed(const solver::Sheet& sheet, const solver::ReleaseOptions& options);

/// The pin friction that it overcomes; none where the design names no pins.
std::optional<solver::PinStudy> pins_of(const solver::Sheet& sheet,
                                        const solver::ReleaseOptions& deploying,
                                        const schema::Design& design);

enum class Advice { none, with };  ///< advice costs several times the bending itself
/// The study of its bent panels.
schema::BentSheet bent_sheet(const solver::Sheet& sheet, const solver::ReleaseOptions& deploying,
                             const schema::Design& design, Advice advice = Advice::with);

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
