// Options that several verbs share: which sheets they choose, and how these are let go.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "schema/exchange/calculix_deck.hpp"
#include "search/sheets/release.hpp"
#include "search/verbs/validators.hpp"

namespace misalign::search {

/// The first argument of verbs that look at sheets.
void add_catalogue_or_pattern(CLI::App& verb, std::string& path);

/// The options that all verbs have which study one sheet; each has more of its own.
struct SheetCall {
  std::string path;                   ///< a catalogue or a pattern file
  std::optional<std::uint64_t> draw;  ///< of a catalogue's campaign, accepted or not
  bool json = false;
};
void add_sheet(CLI::App& verb, SheetCall& call);

/// --draw, as often as there are draws.
CLI::Option* add_draws(CLI::App& group, std::vector<std::uint64_t>& draws, const std::string& what);

/// --stiffness, of other springs than the campaign's.
void add_stiffness(CLI::App& verb, std::optional<double>& stiffness_n_per_mm);
void add_preload(CLI::App& verb, std::optional<double>& preload_n);
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
  double rest_deg = SimulationStart{}.rest_deg;
  std::optional<double> density_g_per_cm3;  ///< the material's otherwise

  /// Of a sheet of this design, in which what was typed is already.
  SimulationStart of(const schema::Design& whole) const;
};
void add_release(CLI::App& verb, ReleaseCall& call);

/// --mesh and --material: of panels as elastic shells.
struct DeckCall {
  schema::DeckOptions deck;  ///< but for the material
  std::string material_file;

  schema::DeckOptions of(const schema::Design& whole) const;
};
void add_deck(CLI::App& verb, DeckCall& call);
/// --material, of the panels: a file, and what it says into what was typed. UserError (bad_input).
void add_material(CLI::App& verb, std::string& file);
void read_material(const std::string& file, schema::Design& design);
/// --trim, of the plates' corners.
void add_trim(CLI::App& verb, std::optional<double>& trim_mm);

/// The first option of a group that was given; empty if none was.
std::string first_given(const CLI::App& group);

}  // namespace misalign::search
