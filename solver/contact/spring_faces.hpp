// Places the springs of a sheet on its faces, so that no two of them meet at any angle, and orders
// their hanging.
//
// The hooks of a spring hang in from one face at both ends, and its axis lies in the mid-plane or
// in a layer on that face, so that its body clears the panels' face. Two springs are in conflict
// where their bodies meet in these layers between flat and the angle of use, or where they have the
// same vertex, face and layer: then one hook lies on the other. The layers are a colouring of the
// springs without conflict that raises them least.
#pragma once

#include <optional>
#include <vector>

#include "solver/contact/spring_clearance.hpp"

namespace misalign::solver {

enum class SheetFace { above, below };

/// Layers that are tried on each face: the mid-plane, and two above it.
inline constexpr int kSpringLayers = 3;
/// Room between a spring's body and the face below it, or the next layer.
inline constexpr double kLayerGap_mm = 0.25;

/// Height of a layer's axes off the mid-plane, mm; layer 0 is the mid-plane.
double layer_height_mm(const SpringBodies& bodies, int layer);

struct HungSpring {
  int diagonal;
  SheetFace face;
  int layer;
  double height_mm;  ///< height of its axis off the mid-plane, negative below
  int turn;          ///< place in the order of hanging, from 0
};

struct SpringFaces {
  SpringBodies bodies;
  double to_deg;                    ///< springs are clear between flat and this angle
  std::vector<HungSpring> springs;  ///< ascending diagonals; none: no such layers exist
  /// The closest two springs, or spring and panel, in these layers.
  std::optional<SpringMeeting> closest;
  double length_change_mm = 0;  ///< largest change of a length by its ends' heights
  /// True if the energy rises from flat with the lengths that heights give.
  bool drives = true;
  bool is_proven = true;  ///< false where the search ended before all layers were tried
};

/// Layers of the springs of a filling (`bodies.fill`). Springs of the same face hang from the
/// lowest layer up, those below first. Panels are trimmed as `trimmed_panels` does it. Faults:
/// to_deg beyond D; end_mm leaves nothing of a spring. Reason: path_lost.
StudyResult<SpringFaces> spring_faces(const Sheet& sheet, const SpringBodies& bodies,
                                      double to_deg);

}  // namespace misalign::solver
