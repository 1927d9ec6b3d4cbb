// The deployment of a released sheet, as JSON.
#pragma once

#include "schema/exchange/folding_json.hpp"
#include "solver/motion/pin_friction.hpp"

namespace misalign::schema {

/// The two numbers of it that rank sheets, {"deploy_time_s", "critical_friction_n_mm_per_mm"}: null
/// where it does not get to flat.
Json deployment_metrics_json(const solver::DeploymentStudy& study);

/// Those, and what was let go: what an exported candidate says.
Json exported_deployment_json(const solver::DeploymentStudy& study);

/// Those and everything else but the motion itself: what was let go, its outcome, equilibria,
/// friction.
Json deployment_json(const solver::Mechanism& mechanism, const solver::DeploymentStudy& study);

/// That, and the rows of the motion as arrays: time_s, pilot_deg, rate_deg_per_s, energy_n_mm (of
/// the springs), kinetic_n_mm, total_n_mm; its events; and the forces in the joints if they were
/// found.
Json deployment_history_json(const solver::Mechanism& mechanism,
                             const solver::DeploymentStudy& study);

/// Pins under load: critical mu r, and where it locks.
Json pins_json(const solver::PinStudy& study);

}  // namespace misalign::schema
