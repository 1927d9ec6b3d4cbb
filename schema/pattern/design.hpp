// Defines the `design` block of campaign and pattern files: properties and requirements of a sheet
// as built.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "schema/pattern/crease_cut.hpp"
#include "schema/pattern/design_fill.hpp"
#include "schema/pattern/hinge_table.hpp"
#include "schema/pattern/material.hpp"
#include "schema/pattern/pattern.hpp"
#include "solver/motion/actuators.hpp"
#include "solver/motion/film_hinge.hpp"
#include "solver/motion/plates.hpp"

namespace misalign::solver {
enum class JointKind;
}  // namespace misalign::solver

namespace misalign::solver {
struct SpringBodies;
}  // namespace misalign::solver

namespace misalign::schema {

/// A design, outside the identity of a campaign: it changes no draw and no verdict. Studies have
/// their own defaults for absent values. Options of a command form a design, too, which overrides a
/// file's (`merged_over`). A number is a member here, a line of the table in design.cpp, and a key
/// in campaign.schema.json.
struct Design : DesignFill {
  std::optional<double> from_deg;  ///< angle of use: the sheet is used from here to flat
  /// "hinges": dry friction and stiffness per rad, both per length of crease.
  std::optional<double> friction_n_mm_per_mm, hinge_stiffness_n_mm_per_mm;
  std::optional<double> pin_friction_mm;  ///< mu r of hinges' pins and ball joints
  std::optional<solver::FilmHinge> film;  ///< gives stiffness and friction where they are not given
  std::optional<CreaseCut> hinge_kind;
  std::optional<std::string> hinge_name;  ///< hinges that the values are of
  std::optional<double> thickness_mm;     ///< panel thickness
  std::optional<Material> material;       ///< material of the panels
  std::optional<double> miscut_mm;        ///< largest cutting error of vertices
  std::optional<double> play_mm;  ///< radius of the ball in which each joint settles (backlash)
  /// "joints": ball joints as they are made (joint_play.hpp), which give the play where it is not
  /// given.
  std::optional<solver::JointKind> joint_kind;
  std::optional<double> joint_bore_mm, wire_mm, joint_edge_mm, joint_clearance_mm, strip_mm;
  std::optional<std::array<int, 2>> hold;  ///< row and column of the held panel
  std::optional<bool> hold_flat;           ///< true: a stop, latch or frame holds the sheet at flat
  std::optional<std::array<double, 3>> gravity;  ///< x, y, z in standard gravities
  /// "wanted" of a card: margins of moment and energy over friction, the angle down to which; yield
  /// of miscut copies; landing rate.
  std::optional<double> static_margin, margin_to_deg, energy_margin, yield, landing_deg_per_s;

  /// Returns this design, completed by `other`: a filling with a kind replaces the other's, and
  /// hinges with a name the other's, but for their play where these have none.
  /// UserError (bad_request) where this has values of springs, and the other another filling;
  /// `rest_deg` is of every filling.
  Design merged_over(Design other) const;

  /// Takes from a row of the hinge table what this design does not say.
  void take_hinge(const HingeRow& row);

  /// Relaxes springs or plates at the target, unless the design says where.
  void relax_at(const std::optional<FoldedTarget>& target);

  solver::Actuators actuators(const solver::PerforatedSheet& base) const;
  /// Returns the hinges' kind, otherwise the material's, otherwise `standard`.
  CreaseCut crease_or(CreaseCut standard) const;
  /// Returns the hinges' stiffness, otherwise that of the film.
  double hinge_elastic_n_mm_per_mm() const;
  solver::Plates plates() const;
  /// Returns the springs as bodies, of a usual diameter (solver::kSpringDiameter_mm) where none is
  /// given. The filling must be springs.
  solver::SpringBodies spring_bodies(std::optional<double> end_mm = {}) const;
};

/// Bounds of a design's numbers, also on the command line.
struct DesignLimits {
  double least, most;
};
/// Returns the bounds of a key, such as "springs.stroke_limit", by the table.
DesignLimits design_limits(std::string_view key);

struct DesignNumber {
  /// "springs", "stiffness_n_per_mm"; "" for the design itself, "plate" for a filling of that kind.
  std::string_view block, key;
  std::optional<double> Design::*number;
  double least, most;
  std::optional<double> standard;  ///< default; none: null
  const char* suggestion;
};
std::span<const DesignNumber> design_numbers();
/// Returns a number's place in a file: "design.springs.preload_n".
std::string key_of(const DesignNumber& row, const Design& design);

}  // namespace misalign::schema
