// One sheet folded, with everything that is shown of it: any shifts of a base pattern.
#pragma once

#include "schema/exchange/folding_json.hpp"
#include "search/draws/models.hpp"
#include "solver/design/actuators.hpp"
#include "solver/sheet/panels.hpp"

namespace misalign::search {

/// Springs other than the campaign's; what is absent stays.
struct OtherActuators {
  std::optional<double> stiffness_n_per_mm, stroke_limit;
  solver::Actuators instead_of(solver::Actuators actuators) const;
};

struct FoldedSheet {
  Eigen::Matrix2Xd shifts_mm;
  solver::FlatVertices vertices_mm;
  solver::ShapedPath path;
  solver::Actuation actuation;
  std::optional<solver::Metrics> metrics;  ///< where it deploys from anything at all
};

class SheetFolder {
 public:
  /// `base` must outlive this object; its own shifts do not matter.
  SheetFolder(const schema::Pattern& base, const schema::Sampling& sampling,
              const solver::Actuators& actuators, const StationOptions& stations = {});
  /// A campaign's sheets, with its springs.
  explicit SheetFolder(const schema::Campaign& campaign, const StationOptions& stations = {});
  SheetFolder(const SheetFolder&) = delete;
  SheetFolder& operator=(const SheetFolder&) = delete;

  /// One column of shifts per vertex.
  FoldedSheet fold(const Eigen::Matrix2Xd& shifts_mm) const;
  /// Its path alone: without springs and metrics.
  solver::ShapedPath follow(const Eigen::Matrix2Xd& shifts_mm) const;
  /// Refers to `folded` and to this object.
  schema::FoldingView view(const FoldedSheet& folded) const;
  /// Of its springs: actuation_history_json, and "deploys_from_deg".
  schema::Json springs_json(const FoldedSheet& folded) const;
  /// UserError (6) if the shapes of these rows are not the flat sheet's panels, folded as the
  /// history says: judged by coordinates alone. `name` is the sheet's in the sentence.
  void check_shapes(const FoldedSheet& folded, const std::vector<Eigen::Index>& rows,
                    const std::string& name) const;

  const schema::Pattern& base() const { return base_; }
  const schema::Sampling& sampling() const { return sampling_; }
  const solver::Actuators& actuators() const { return actuators_; }
  const solver::Mechanism& mechanism() const { return model_.mechanism(); }

 private:
  const schema::Pattern& base_;
  const schema::Sampling sampling_;
  const solver::Actuators actuators_;
  const solver::Model model_;
  const solver::Panels panels_;
};

}  // namespace misalign::search
