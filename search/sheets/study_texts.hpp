// The studies of a sheet, as text.
#pragma once

#include <string>

#include "schema/exchange/bent_panels_json.hpp"
#include "schema/exchange/stock_choice_json.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "search/sheets/better_sheet.hpp"
#include "search/sheets/stress_study.hpp"
#include "solver/contact/contact.hpp"
#include "solver/contact/spring_faces.hpp"
#include "solver/fitting/cut_outs.hpp"
#include "solver/fitting/spring_choice.hpp"
#include "solver/motion/actuation.hpp"
#include "solver/motion/pin_friction.hpp"
#include "solver/motion/rubber.hpp"
#include "solver/optimise/construct.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::search {

/// The weakest point, the fewest springs and the stroke; then energy and moment every 10
/// degrees and at D; then the force on each diagonal at D.
std::string actuators_text(const solver::Sheet& sheet, const solver::Actuation& actuation);

/// `rigid`: the same sheet with rigid panels, an upper bound.
std::string bent_panels_text(const schema::BentSheet& sheet, const solver::FrictionLimits& rigid);

/// Results of the theorem of parallel redrawing, then a line a hole.
std::string construct_text(const schema::Pattern& base, const solver::ConstructStudy& study,
                           double at_deg);

/// The first contact, the maximum thickness, and the least distances every 10 degrees.
std::string contact_text(const schema::Pattern& base, const solver::Panels& panels,
                         const solver::ContactStudy& study);

/// Springs that touch, or are closest; and distances of axes every 10 degrees. Empty where springs
/// were not judged.
std::string spring_clearance_text(const schema::Pattern& base, const solver::Panels& panels,
                                  const solver::ContactStudy& study);
/// The closest two springs, or spring and panel, and the numbers of pairs that touch.
std::string spring_clearance_note(const schema::Pattern& base, const solver::Panels& panels,
                                  const solver::SpringClearance& clearance);

/// The smallest clearance in these layers, and what heights do to the springs; or that none exist.
std::string spring_faces_text(const solver::SpringFaces& faces);
/// A line a spring: its turn, face and layer. Empty where no layers exist.
std::string spring_faces_table(const solver::Mechanism& mechanism,
                               const solver::SpringFaces& faces);

/// The released sheet, the outcome, equilibria and friction, and the motion every few degrees.
std::string deployment_text(const solver::Mechanism& mechanism,
                            const solver::DeploymentStudy& study);

/// The friction that chosen springs overcome, its bounds, and each spring.
std::string spring_choice_text(const solver::Sheet& sheet, const solver::SpringChoice& choice);

/// Springs to buy: price, friction overcome, equal springs, and each spring's lengths.
std::string bought_springs_text(const solver::Sheet& sheet, const schema::SpringOrder& order);

/// The pin friction that it overcomes, a line for each place of pins.
std::string pins_text(const solver::PinStudy& study);

/// `sheet`: the optimum.
std::string optimise_text(const Subject& subject, const solver::Sheet& sheet,
                          const ProvenBetter& better);

/// The plates' equivalent springs, then a line a hole: largest stretch, largest force on an edge,
/// and where the plate wrinkles or is slack.
std::string rubber_text(const solver::Sheet& sheet, const solver::RubberStudy& study);

/// The least drive of chosen cut-outs, then a line a hole.
std::string cut_outs_text(const solver::Sheet& sheet, const solver::CutOutChoice& choice);

/// The release, the outcome and the largest stresses; then the motion in at most
/// twenty rows, beside that of rigid panels.
std::string stress_text(const schema::SimulatedSheet& sheet, const StressStudyOptions& options,
                        const solver::StressStudy& study);

}  // namespace misalign::search
