// What a sheet is built of and used for: the `design` block of campaign and pattern files.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "schema/pattern/material.hpp"
#include "solver/motion/actuators.hpp"
#include "solver/motion/film_hinge.hpp"
#include "solver/motion/plates.hpp"

namespace misalign::schema {

/// What is made of a crease.
enum class CreaseCut {
  cut,    ///< every panel is a part of its own, to be hinged by tape or textile
  score,  ///< a line
  dash,   ///< a perforation: cuts with bridges between
};
struct CreaseCutName {
  const char* name;
  CreaseCut cut;
};
inline constexpr CreaseCutName kCreaseCuts[] = {
    {"cut", CreaseCut::cut}, {"score", CreaseCut::score}, {"dash", CreaseCut::dash}};

/// Outside the identity of a campaign: it says what is asked of sheets, and changes no draw and no
/// verdict. What is absent is not said; studies then take their own defaults. Options of a command
/// are a design too, which goes before a file's (`merged_over`). A number is a member here, a line
/// of the table in design.cpp, and a key in campaign.schema.json.
struct Design {
  std::optional<double> from_deg;  ///< the sheet is used between this pilot angle and flat
  /// "springs", on every diagonal: also what is left in each at flat, and the most each bears.
  std::optional<double> stiffness_n_per_mm, stroke_limit, preload_n, largest_force_n;
  /// "springs.preloads_n": of those that have another one; goes with `preload_n`.
  std::vector<solver::Preload::OfOne> other_preloads;
  /// "hinges": dry friction per length of crease, and stiffness for each rad.
  std::optional<double> friction_n_mm_per_mm, hinge_stiffness_n_mm_per_mm;
  std::optional<double> pin_friction_mm;  ///< mu r of hinges' pins and ball joints
  std::optional<solver::FilmHinge> film;  ///< stiffness and friction, where these are not said
  std::optional<CreaseCut> hinge_kind;
  std::optional<double> thickness_mm;  ///< of panels
  std::optional<Material> material;    ///< of panels
  std::optional<double> miscut_mm;     ///< vertices are cut this much off their places at most
  std::optional<double> play_mm;  ///< radius of the ball in which each joint settles (backlash)
  std::optional<std::array<int, 2>> hold;        ///< row and column of the panel that is held
  std::optional<std::array<double, 3>> gravity;  ///< x, y, z in standard gravities
  /// "wanted" of a card: margins of moment and energy over friction, down to which angle; a share
  /// of miscut copies; how fast it may land.
  std::optional<double> static_margin, margin_to_deg, energy_margin, yield, landing_deg_per_s;

  /// What this says, and otherwise what `other` says.
  Design merged_over(Design other) const;

  solver::Actuators actuators() const;
  /// As said, or that of the film.
  double hinge_elastic_n_mm_per_mm() const;
  solver::Plates plates() const;
};

/// The bounds of its numbers, here and on the command line.
struct DesignLimits {
  double least, most;
};
/// Of "springs.stroke_limit", say, as the table has it.
DesignLimits design_limits(std::string_view key);

struct DesignNumber {
  std::string_view block, key;  ///< of "springs" "stiffness_n_per_mm"; of the block itself ""
  std::optional<double> Design::*number;
  double least, most;
  std::optional<double> standard;  ///< what holds where it is not said; none: null
  const char* suggestion;
};
std::span<const DesignNumber> design_numbers();

}  // namespace misalign::schema
