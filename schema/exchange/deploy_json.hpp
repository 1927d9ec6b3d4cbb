// Writes the deployment of a released sheet as JSON.
#pragma once

#include "schema/exchange/folding_json.hpp"
#include "solver/motion/pin_friction.hpp"

namespace misalign::schema {

/// {"deploy_time_s", "critical_friction_n_mm_per_mm"}, which rank sheets: null where the sheet does
/// not reach flat.
Json deployment_metrics_json(const solver::DeploymentStudy& study);

/// deployment_metrics_json and the released sheet, for exported candidates.
Json exported_deployment_json(const solver::DeploymentStudy& study);

/// exported_deployment_json, outcome, equilibria and friction, without the motion. The filling is
/// "springs", or another "fill".
Json deployment_json(const solver::Sheet& sheet, const solver::DeploymentStudy& study);

/// deployment_json, and the motion as arrays: time_s, pilot_deg, rate_deg_per_s, energy_n_mm (of
/// the filling), kinetic_n_mm, total_n_mm; its events; the forces in the joints if they are known.
Json deployment_history_json(const solver::Sheet& sheet, const solver::DeploymentStudy& study);

/// Friction of pins: critical mu r, and locking.
Json pins_json(const solver::PinStudy& study);

}  // namespace misalign::schema
