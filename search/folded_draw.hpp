// One draw of a campaign folded again, with everything that is shown of it.
#pragma once

#include "schema/folding_json.hpp"
#include "solver/actuation.hpp"
#include "solver/elimination.hpp"
#include "solver/fold_lines.hpp"

namespace misalign::search {

/// Springs other than the campaign's; what is absent stays.
struct OtherActuators {
  std::optional<double> stiffness_n_per_mm, stroke_limit;
  solver::Actuators instead_of(solver::Actuators actuators) const;
};

struct FoldedDraw {
  std::uint64_t draw;
  bool accepted;
  Eigen::Matrix2Xd shifts_mm;
  solver::FlatVertices vertices_mm;
  solver::ShapedPath path;
  solver::Actuation actuation;
  std::optional<solver::Metrics> metrics;  ///< where it deploys from anything at all
};

class DrawFolder {
 public:
  /// Also looks at multiples of `look_deg` between the samples; 0: at none. `campaign` must outlive
  /// this object.
  explicit DrawFolder(const schema::Campaign& campaign, double look_deg = 0);
  DrawFolder(const DrawFolder&) = delete;
  DrawFolder& operator=(const DrawFolder&) = delete;

  FoldedDraw fold(std::uint64_t draw) const;
  /// Refers to `folded` and to this object.
  schema::FoldingView view(const FoldedDraw& folded) const;
  /// UserError (6) if the shapes of these rows are not the flat sheet's panels, folded as the
  /// history says: judged by coordinates alone.
  void check_shapes(const FoldedDraw& folded, const std::vector<Eigen::Index>& rows) const;

  const solver::Mechanism& mechanism() const { return mechanism_; }

 private:
  const schema::Campaign& campaign_;
  const solver::Mechanism mechanism_;
  const solver::Elimination elimination_;
  const solver::PathPlan plan_;
  const solver::Panels panels_;
};

}  // namespace misalign::search
