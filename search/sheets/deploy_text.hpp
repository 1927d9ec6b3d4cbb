// The deployment of a released sheet, as text.
#pragma once

#include <string>

#include "solver/motion/pin_friction.hpp"

namespace misalign::search {

/// What was let go, what came of it, equilibria and friction, and the motion every few degrees.
std::string deployment_text(const solver::Mechanism& mechanism,
                            const solver::DeploymentStudy& study);

/// What friction of pins it overcomes, in three lines.
std::string pins_text(const solver::PinStudy& study);

}  // namespace misalign::search
