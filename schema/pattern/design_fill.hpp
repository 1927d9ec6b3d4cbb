// Defines the filling of a sheet's holes in a design, before its sheet is known.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/fill/fill.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::schema {

enum class FillKind { springs, plate, none };
struct FillKindName {
  const char* name;
  FillKind kind;
};
inline constexpr FillKindName kFillKinds[] = {
    {"springs", FillKind::springs}, {"plate", FillKind::plate}, {"none", FillKind::none}};

/// The filling: numbers, of which absent ones have the defaults of solver/fill/fill.hpp. They are
/// lines of the table in design.cpp, too.
struct DesignFill {
  std::optional<FillKind> fill_kind;  ///< none: springs
  /// Pilot angle at which springs or plates are relaxed.
  std::optional<double> rest_deg;

  /// Springs: the last three are limits, and the room that a spring needs.
  std::optional<double> stiffness_n_per_mm, preload_n, stroke_limit, largest_force_n, diameter_mm;
  std::vector<solver::Preload::OfOne> other_preloads;  ///< the others have `preload_n`
  std::optional<bool> pull_only;
  std::optional<solver::SpringsOn> springs_on;
  std::vector<solver::SingleSpring> single_springs;

  /// Plates, in N/mm^2 and mm; `prestretch` has no unit.
  std::optional<double> shear_mpa, plate_mm, prestretch;
  struct CutOut {
    std::array<int, 2> hole;  ///< its row and column
    std::array<double, 2> of_flat;
  };
  std::vector<CutOut> cut_outs;

  /// Returns the key of a design that holds this filling.
  const char* fill_key() const { return fill_kind ? "fill" : "springs"; }
  bool is_springs() const { return fill_kind.value_or(FillKind::springs) == FillKind::springs; }
  bool is_plate() const { return fill_kind == FillKind::plate; }
  /// Returns the name of diagonals in drawings: "springs" where there are some.
  const char* diagonals_name() const { return is_springs() ? "springs" : "diagonals"; }

  /// Returns the filling of a sheet that has the holes named (fill_json.hpp: find_fill_faults).
  solver::Fill fill(const solver::PerforatedSheet& base) const;
  /// Returns the springs. The filling must be springs.
  solver::Springs springs() const;
};

/// Returns the index among the holes of the one at this row and column; -1 if there is none.
int hole_at(const solver::PerforatedSheet& base, const std::array<int, 2>& place);

/// Returns the design of a filling of a sheet: the inverse of `fill`.
DesignFill design_of(const solver::Fill& fill, const solver::PerforatedSheet& base);

}  // namespace misalign::schema
