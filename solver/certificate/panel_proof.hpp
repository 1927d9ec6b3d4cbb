// Proves that no two panels, without thickness, meet on an interval of a path.
//
// Directions are found in the middle of a part of the interval and kept on it; where one does not
// suffice, the part is halved. Near flat, z / tau replaces z: stretching space keeps planes and
// their sides.
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
    double until = 1;  ///< no panels meet from s = -1 to here
    int pair = -1;     ///< first pair for which that is not proven farther on
  };
  /// Proves it all over a tube, or up to an s that is exact to `resolution`. Pairs are those of
  /// pairs_of(panels).
  Apart prove(const TubeProver& prover, const PathTube& tube, double resolution) const;

 private:
  const FoldedShape& shape_;
  const Panels& panels_;
  const std::vector<ComparedPanels> compared_;
};

}  // namespace misalign::solver
