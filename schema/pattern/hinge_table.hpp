// Lists hinges by name, each with its source.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "schema/files/input.hpp"
#include "schema/pattern/crease_cut.hpp"
#include "solver/motion/film_hinge.hpp"
#include "solver/studies/option_fault.hpp"

namespace misalign::schema {

/// A hinge by name. Where sources give a range, friction is at its upper end and play in its
/// middle.
struct HingeRow {
  std::string_view name;
  std::optional<solver::FilmHinge> film;
  std::optional<double> friction_n_mm_per_mm, pin_friction_mm;
  std::optional<double> play_mm;  ///< half the diametral clearance
  CreaseCut crease;               ///< making of creases in a kit with these hinges
  std::string_view source;
};

std::span<const HingeRow> hinge_table();
/// Returns the row of that name; null if there is none.
const HingeRow* find_hinge(std::string_view name);
std::vector<std::string> hinge_names();
/// Returns the fault of a name that no row has, of the parameter "hinge".
solver::OptionFault unknown_hinge(const std::string& typed);

Json film_json(const solver::FilmHinge& film);

/// Returns a list of objects with the row's values, and the stiffness of its film.
Json hinge_table_json();
std::string hinge_table_markdown();

}  // namespace misalign::schema
