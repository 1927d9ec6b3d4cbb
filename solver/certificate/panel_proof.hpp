// That no two panels meet on a piece of a path, panels being without thickness.
//
// Panels without a common vertex: some direction has all corners of the one on one side and all of
// the other's on the other. With one common vertex V: some plane through V has the other three
// corners of the one, and hence all of it but V, on one side, those of the other on the other. With
// a common crease: they lie in two half planes from it, which meet in it alone unless its fold
// angle is
// +-180 degrees; of that the conditions on creases say that it is not.
//
// Directions are found in the middle of a part of the piece and kept on it; where one does not do,
// the part is halved. Near flat, z over tau stands for z: stretching space keeps planes, and sides.
#pragma once

#include <vector>

#include "solver/certificate/tube_prover.hpp"
#include "solver/design/contact.hpp"

namespace misalign::solver {

class PanelProof {
 public:
  /// All must outlive this object.
  PanelProof(const Mechanism& mechanism, const FoldedShape& shape, const Panels& panels);

  struct Apart {
    double until = 1;  ///< from s = -1 to here no panels meet
    int pair = -1;     ///< index of the first two of which that could not be shown farther on
  };
  /// All over a tube, or up to where it is not shown, found to within `resolution`. Pairs are those
  /// of pairs_of(panels).
  Apart look(const TubeProver& prover, const PathTube& tube, double resolution) const;

 private:
  const Mechanism& mechanism_;
  const FoldedShape& shape_;
  const Panels& panels_;
  const std::vector<PanelPair> pairs_;
};

}  // namespace misalign::solver
