// Proves that no two panels meet on an interval of a path, panels being without thickness.
//
// Directions are found in the middle of a part of the interval and kept on it; where one does not
// do, the part is halved. Near flat, z over tau stands for z: subintervaling space keeps planes,
// and sides.
#pragma once

#include <vector>

#include "solver/certificate/panel_directions.hpp"
#include "solver/certificate/tube_prover.hpp"

namespace misalign::solver {

class PanelProof {
 public:
  /// Both must outlive this object.
  PanelProof(const FoldedShape& shape, const Panels& panels);

  struct Apart {
    double until = 1;  ///< from s = -1 to here no panels meet
    int pair = -1;     ///< index of the first two of which that could not be shown farther on
  };
  /// All over a tube, or up to where it is not shown, found to within `resolution`. Pairs are those
  /// of pairs_of(panels).
  Apart prove(const TubeProver& prover, const PathTube& tube, double resolution) const;

 private:
  const FoldedShape& shape_;
  const Panels& panels_;
  const std::vector<ComparedPanels> compared_;
};

}  // namespace misalign::solver
