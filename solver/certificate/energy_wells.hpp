// Proves where the total energy of what fills the holes is stationary along the folding path, and
// so the number of wells in which a sheet can rest.
#pragma once

#include <optional>
#include <vector>

#include "solver/fill/fill.hpp"
#include "solver/records/certificate.hpp"
#include "solver/sheet/sheet.hpp"
#include "solver/studies/study_result.hpp"

namespace misalign::solver {

enum class Stationary { well, top };
/// Names as in files: "well", "top".
const char* name_of(Stationary kind);

/// An energy at a stationary point, known to within `error_n_mm`.
struct ProvenEnergy {
  double n_mm, error_n_mm;
};

/// Pilot angles, at most 0.01 degrees apart, between which the energy has one stationary point. It
/// has no other between these parts.
struct StationaryPoint {
  Stationary kind;
  double from_deg, to_deg;
  ProvenEnergy energy;
};

struct EnergyWells {
  double asked_deg = 0;
  double proven_deg = 0;  ///< all of this is proven from flat to here
  /// The reason why the proof ends; `where` is as in Certificate.
  CertificateEnd end = CertificateEnd::flat_branch;
  int where = -1;
  /// The kind of flat, where the energy is stationary always; none where nothing is proven.
  std::optional<Stationary> flat;
  ProvenEnergy flat_energy{};
  /// All stationary points up to proven_deg but flat, ascending: wells and tops in turn.
  std::vector<StationaryPoint> points;

  /// The number of wells but flat.
  int wells() const;
};

/// Proves the wells from flat to `to_deg` (at most 180), or as far as there is a proof. Springs are
/// taken as numbers: rates and free lengths are the doubles of the sheet's Filling. An OptionFault
/// ("fill", "rest_deg") for fillings without such a proof (why_no_wells), or that are relaxed
/// beyond the path's end. Springs must end in the panels' mid-plane.
StudyResult<EnergyWells> prove_wells(const Sheet& sheet, const Fill& fill, double to_deg);

}  // namespace misalign::solver
