// The studies of a sheet, as text.
#pragma once

#include <string>

#include "schema/exchange/bent_panels_json.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "search/sheets/better_sheet.hpp"
#include "search/sheets/stress_study.hpp"
#include "solver/contact/contact.hpp"
#include "solver/motion/actuation.hpp"
#include "solver/motion/pin_friction.hpp"
#include "solver/optimise/construct.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::search {

/// The weakest point, the few springs that would do and the stroke; then energy and moment every 10
/// degrees and at D; then the force on each diagonal at D.
std::string actuators_text(const solver::Sheet& sheet, const solver::Actuation& actuation);

/// `rigid`: the same sheet with rigid panels, an upper bound.
std::string bent_panels_text(const schema::BentSheet& sheet, const solver::FrictionLimits& rigid);

/// What the theorem of parallel redrawing says of this sheet, then a line a hole.
std::string construct_text(const schema::Pattern& base, const solver::ConstructStudy& study,
                           double at_deg);

/// Where panels first meet, how thick they may be, and the least distances every 10 degrees.
std::string contact_text(const schema::Pattern& base, const solver::Panels& panels,
                         const solver::ContactStudy& study);

/// What was let go, what came of it, equilibria and friction, and the motion every few degrees.
std::string deployment_text(const solver::Mechanism& mechanism,
                            const solver::DeploymentStudy& study);

/// What friction of pins it overcomes, in three lines.
std::string pins_text(const solver::PinStudy& study);

/// `sheet`: the one that was found.
std::string optimise_text(const Subject& subject, const solver::Sheet& sheet,
                          const ProvenBetter& better);

/// How it was let go, whether it deployed and the largest stresses; then the motion in at most
/// twenty rows, beside that of rigid panels.
std::string stress_text(const schema::SimulatedSheet& sheet, const StressStudyOptions& options,
                        const solver::StressStudy& study);

}  // namespace misalign::search
