// A sheet let go: what is wished of it, checked against how far it folds, and what comes of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/campaign/pattern_file.hpp"
#include "solver/design/actuators.hpp"
#include "solver/design/deploy.hpp"

namespace misalign::search {

/// The paper's "20 % folded".
inline constexpr double kDeployFrom_deg = 36;

/// What options say of a deployment; the rest is the default of the structures below.
struct DeployWish {
  std::optional<double> from_deg;            ///< none: kDeployFrom_deg, or D where that is less
  std::optional<double> stiffness_n_per_mm;  ///< none: the campaign's
  std::vector<std::string> other_rests;      ///< "A11-A17=60"
  std::optional<std::string> held;           ///< "0,0": row and column of a panel
  std::vector<double> gravity;               ///< x, y, z in standard gravities, or none
  solver::DeployingSheetOptions sheet;
  solver::DeploymentOptions options;
  std::optional<solver::JointForcesOptions> forces;  ///< none: they are not found
};

class Deployer {
 public:
  /// `base` must outlive this object. UserError (2) where the wish does not fit its panels or
  /// diagonals.
  Deployer(const schema::Pattern& base, const schema::Sampling& sampling,
           const solver::Actuators& actuators, const DeployWish& wish);
  Deployer(const Deployer&) = delete;
  Deployer& operator=(const Deployer&) = delete;

  /// D of the sheet with these shifts.
  double deploys_from_deg(const Eigen::Matrix2Xd& shifts_mm) const;
  /// Of that sheet, which deploys from there. UserError: 2 where it does not fold
  /// as far as is wished, 1 where its path is lost or this build is without SUNDIALS; `name` is the
  /// sheet's in the sentence.
  solver::DeploymentStudy study(const Eigen::Matrix2Xd& shifts_mm, double deploys_from_deg,
                                const std::string& name);
  /// The same; none where it cannot be let go.
  std::optional<solver::DeploymentStudy> study_if_possible(const Eigen::Matrix2Xd& shifts_mm,
                                                           double deploys_from_deg);

  const solver::Mechanism& mechanism() const { return model_.mechanism(); }

 private:
  void check_angles(const solver::FoldingWay& way, double from_deg, const std::string& name) const;

  const schema::Pattern& base_;
  const double sample_deg_;
  const bool from_is_wished_;
  const solver::Model model_;
  solver::DeployingSheetOptions sheet_;
  solver::DeploymentOptions options_;
  const std::optional<solver::JointForcesOptions> forces_;
  solver::WaySolver ways_;
};

}  // namespace misalign::search
