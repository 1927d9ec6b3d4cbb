// Defines the filling of a sheet's holes: springs on their diagonals, rubber plates, or nothing.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "solver/kinematics/mechanism.hpp"

namespace misalign::solver {

/// A diagonal by its vertices, in any order.
struct DiagonalEnds {
  int from, to;
  bool is_on(const Diagonal& diagonal) const {
    return std::minmax(from, to) == std::minmax(diagonal.from, diagonal.to);
  }
};

/// Forces left in the springs of a flat sheet: those on diagonals that lengthen as the sheet folds
/// pull, those on diagonals that shorten push.
struct Preload {
  double each_n = 0;
  struct OfOne : DiagonalEnds {
    double n;
  };
  std::vector<OfOne> others = {};  ///< springs with another force

  bool is_any() const { return largest_n() > 0; }
  /// The largest force given.
  double largest_n() const {
    double largest_n = each_n;
    for (const OfOne& other : others) largest_n = std::max(largest_n, other.n);
    return largest_n;
  }
  /// Force of one diagonal's spring.
  double force_n(const Diagonal& diagonal) const {
    const auto is_its = [&](const OfOne& other) { return other.is_on(diagonal); };
    const auto at = std::ranges::find_if(others, is_its);
    return at == others.end() ? each_n : at->n;
  }
  /// Forces of all diagonals' springs. Vertices that are no diagonal have no effect.
  Eigen::VectorXd forces_n(const std::vector<Diagonal>& diagonals) const {
    return Eigen::VectorXd::NullaryExpr(std::ssize(diagonals), [&](Eigen::Index d) {
      return force_n(diagonals[static_cast<std::size_t>(d)]);
    });
  }
};

/// A spring with a rate, and a free length, of its own.
struct SingleSpring : DiagonalEnds {
  double stiffness_n_per_mm;      ///< 0: the diagonal has no spring
  std::optional<double> free_mm;  ///< none: relaxed where the others are
};

/// Diagonals that have springs.
enum class SpringsOn {
  all,
  one_a_hole  ///< the diagonal that lengthens next to flat, otherwise the hole's first
};

/// Springs on the diagonals (Saito, Tsukahara & Okabe 2016, section 5).
struct Springs {
  double stiffness_n_per_mm = 50;  ///< the paper's springs
  /// The pilot angle at which they are relaxed, and the diagonals that are relaxed at other angles.
  double rest_deg = 0;
  std::vector<std::pair<int, double>> other_rests_deg = {};
  bool pull_only = false;  ///< true of wires: no force where they are shorter than relaxed
  SpringsOn on = SpringsOn::all;
  Preload preload = {};
  std::vector<SingleSpring> single = {};  ///< diagonals with springs of their own, or none
};

/// The stress-free shape of one hole's plate: ratios of its diagonals to those of the flat hole,
/// with the same angle between them.
struct CutOut {
  int hole;  ///< index among the holes, in the order of the diagonals
  std::array<double, 2> of_flat;
};

/// A plate of incompressible rubber in each hole, bonded to its edges (section 6 of the paper).
struct RubberPlates {
  double shear_mpa = 0.5;  ///< shear modulus
  double thickness_mm = 1;
  double prestretch = 1;  ///< lengths in the hole at rest, to those of the cut-out
  double rest_deg = 0;    ///< pilot angle of the rest, where only the pre-stretch is left
  std::vector<CutOut> cut_outs = {};  ///< holes with a cut-out of their own
};

struct NoFill {};

using Fill = std::variant<Springs, RubberPlates, NoFill>;

inline constexpr double kSpringDiameter_mm = 5;
/// Default length of each end that is left out, by diameter: a hook and the eye that holds it.
inline constexpr double kEndDiameters = 2;
/// Springs as round bodies.
struct SpringBodies {
  double diameter_mm = kSpringDiameter_mm;
  std::optional<double> end_mm = {};  ///< none: kEndDiameters diameters
  double panel_mm = 1;                ///< thickness of the panels
  Fill fill = Springs{};

  double left_out_mm() const { return end_mm.value_or(kEndDiameters * diameter_mm); }
};

/// Returns the pilot angle at which a filling is relaxed, apart from preload or pre-stretch.
inline double rest_deg(const Fill& fill) {
  if (const auto* springs = std::get_if<Springs>(&fill)) return springs->rest_deg;
  if (const auto* plates = std::get_if<RubberPlates>(&fill)) return plates->rest_deg;
  return 0;
}

/// Returns whether springs of one rate, with one angle of rest, are on all diagonals.
inline bool on_all_equally(const Springs& springs) {
  return springs.on == SpringsOn::all && springs.single.empty() && springs.other_rests_deg.empty();
}

/// Returns whether a filling is springs of one rate and rest on all diagonals, which push, too.
inline bool are_plain_springs(const Fill& fill) {
  const auto* const springs = std::get_if<Springs>(&fill);
  return springs && on_all_equally(*springs) && !springs->pull_only;
}

/// Returns whether a filling is such springs, or the same on one diagonal of each hole alone.
inline bool are_like_springs(const Fill& fill) {
  const auto* const springs = std::get_if<Springs>(&fill);
  if (!springs) return false;
  Springs everywhere = *springs;
  everywhere.on = SpringsOn::all;
  return are_plain_springs(everywhere);
}

/// Returns whether a filling is relaxed flat, apart from preload or pre-stretch: no part of it has
/// another rest, or a free length of its own.
inline bool is_relaxed_flat(const Fill& fill) {
  const auto* const springs = std::get_if<Springs>(&fill);
  const auto is_own = [](const SingleSpring& spring) { return spring.free_mm.has_value(); };
  return rest_deg(fill) == 0 && (!springs || (springs->other_rests_deg.empty() &&
                                              std::ranges::none_of(springs->single, is_own)));
}

}  // namespace misalign::solver
