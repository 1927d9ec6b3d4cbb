// Options that several verbs share: which values they take, and which sheets they choose.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "schema/exchange/calculix_deck.hpp"
#include "search/sheets/release.hpp"

namespace misalign::search {

/// A number within bounds, which NaN is not.
CLI::Validator within(double least, double most);
/// A number within the bounds of a key of the design block.
CLI::Validator within(std::string_view design_key);

/// A share of one within bounds; what was meant as percent is told from it.
CLI::Validator a_share(double least, double most);

/// A whole number within bounds, written as one: not 1e6.
CLI::Validator counted(std::uint64_t least, std::uint64_t most);
/// Any number of a draw, or of draws.
CLI::Validator a_draw();

/// What is typed, and what it stands for.
template <class Value>
using Names = std::vector<std::pair<std::string, Value>>;

/// One of the names, of an enum's values; `where` ends the sentence about any other.
CLI::Validator one_of_words(const Names<std::string>& names, const std::string& where);
template <class Enum>
CLI::Validator one_of(const Names<Enum>& names, const std::string& where = "") {
  Names<std::string> numbers;  // which CLI11 makes the enum's value of
  for (const auto& [name, value] : names) {
    numbers.emplace_back(name, std::to_string(static_cast<int>(value)));
  }
  return one_of_words(numbers, where);
}

/// One of the words, of which the nearest is suggested for any other: "x is no verb".
CLI::Validator known_word(const std::string& kind, const std::vector<std::string>& known);

/// The first argument of verbs that look at one sheet, and the second that some of them take.
void add_catalogue_or_pattern(CLI::App& verb, std::string& path);
void add_draw_of_catalogue(CLI::App& verb, std::optional<std::uint64_t>& draw);

/// --draw, as often as there are draws.
CLI::Option* add_draws(CLI::App& group, std::vector<std::uint64_t>& draws, const std::string& what);

/// --stiffness, of other springs than the campaign's.
void add_stiffness(CLI::App& verb, std::optional<double>& stiffness_n_per_mm);
/// That and --stroke-limit, of other springs than the design's.
void add_springs(CLI::App& verb, schema::Design& design);

/// --from, the angle between which and flat a sheet is used; `otherwise` ends its line of help.
CLI::Option* add_from(CLI::App& verb, std::optional<double>& from_deg,
                      const std::string& otherwise = "[the design's, or D]");
/// The same where it is let go there.
void add_release_from(CLI::App& verb, std::optional<double>& from_deg, double least_deg);
/// --thickness of its panels.
void add_thickness(CLI::App& verb, std::optional<double>& thickness_mm);
inline constexpr double kLeastDensity_g_per_cm3 = 1e-3, kMostDensity_g_per_cm3 = 100;

/// Those, --rest-deg and --density: of a released sheet.
struct ReleaseCall {
  schema::Design design;  ///< what was typed
  double rest_deg = ReleaseOptions{}.rest_deg;
  std::optional<double> density_g_per_cm3;  ///< the material's otherwise

  /// Of a sheet of this design, in which what was typed is already.
  ReleaseOptions of(const schema::Design& whole) const;
};
void add_release(CLI::App& verb, ReleaseCall& call);

/// --mesh and --material: of panels as elastic shells.
struct DeckCall {
  schema::DeckOptions deck;  ///< but for the material
  std::string material_file;

  schema::DeckOptions of(const schema::Design& whole) const;
};
void add_deck(CLI::App& verb, DeckCall& call);
/// Reads the material file, if there is one, into what was typed. UserError (3).
void read_material(const DeckCall& deck, schema::Design& design);
/// --trim, of the plates' corners.
void add_trim(CLI::App& verb, std::optional<double>& trim_mm);

/// The first option of a group that was given; empty if none was.
std::string first_given(const CLI::App& group);

}  // namespace misalign::search
