// Options that several verbs share: the choice of sheets, and their release.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "schema/exchange/calculix_deck.hpp"
#include "search/sheets/release.hpp"
#include "search/verbs/validators.hpp"
#include "solver/records/certificate.hpp"

namespace misalign::search {

/// Types of values that are names of the tables of materials and hinges.
inline constexpr const char *kMaterial = "MATERIAL", *kHinge = "HINGE";

/// The first argument of verbs on sheets.
void add_catalogue_or_pattern(CLI::App& verb, std::string& path);

/// The common options of verbs that study one sheet.
struct SheetCall {
  std::string path;                   ///< a catalogue or a pattern file
  std::optional<std::uint64_t> draw;  ///< a catalogue's number, accepted or not
  bool json = false;
};
void add_sheet(CLI::App& verb, SheetCall& call);

/// --draw, as often as there are draws.
CLI::Option* add_draws(CLI::App& group, std::vector<std::uint64_t>& draws, const std::string& what);

/// Adds --stiffness, which overrides the design's.
void add_stiffness(CLI::App& verb, std::optional<double>& stiffness_n_per_mm);
void add_preload(CLI::App& verb, std::optional<double>& preload_n);
/// Adds --rest-deg, which overrides the design's.
void add_rest(CLI::App& verb, std::optional<double>& rest_deg);
/// Adds both and --stroke-limit, which override the design's.
void add_springs(CLI::App& verb, schema::Design& design);

/// Adds --from, the angle of use; `otherwise` ends its line of help.
CLI::Option* add_from(CLI::App& verb, std::optional<double>& from_deg,
                      const std::string& otherwise = "[the design's, or D]");
/// The same for the angle of release.
void add_release_from(CLI::App& verb, std::optional<double>& from_deg, double least_deg);
/// --thickness of its panels.
void add_thickness(CLI::App& verb, std::optional<double>& thickness_mm);
/// --hold-flat, which overrides the design's.
void add_hold_flat(CLI::App& verb, std::optional<bool>& hold_flat);
inline constexpr double kLeastDensity_g_per_cm3 = 1e-3, kMostDensity_g_per_cm3 = 100;

/// The options of a released sheet: those, --rest-deg and --density.
struct ReleaseCall {
  schema::Design design;                    ///< typed options
  std::optional<double> density_g_per_cm3;  ///< the material's otherwise

  /// The start of a sheet of this design, into which typed options are merged already.
  SimulationStart of(const schema::Design& whole) const;
};
void add_release(CLI::App& verb, ReleaseCall& call);

/// --mesh and --material: of panels as elastic shells.
struct DeckCall {
  schema::DeckOptions deck;  ///< all but the material
  std::string material;

  schema::DeckOptions of(const schema::Design& whole) const;
};
void add_deck(CLI::App& verb, DeckCall& call);
/// --material, a name or file of the panels' material, which is merged into typed options.
/// UserError (bad_request, bad_input).
void add_material(CLI::App& verb, std::string& typed);
void read_material(const std::string& typed, schema::Design& design);
/// --hinge, a name of the hinge table, whose values are merged into typed options where these have
/// none. UserError (bad_request).
void add_hinge(CLI::App& verb, std::string& typed);
void read_hinge(const std::string& typed, schema::Design& design);
/// --joint, --joint-bore and --wire, of ball joints; returns the first.
CLI::Option* add_joints(CLI::App& verb, schema::Design& design);
/// --joint and --wire alone.
CLI::Option* add_joint(CLI::App& verb, schema::Design& design);
/// --fill, JSON as of `design.fill`. Called after the options of springs, which it excludes.
void add_fill(CLI::App& verb, schema::DesignFill& fill);
/// --criterion: how sheets are judged.
CLI::Option* add_criterion(CLI::App& verb, std::optional<solver::CertifiedBy>& criterion);
/// --trim, of the plates' corners.
void add_trim(CLI::App& verb, std::optional<double>& trim_mm);

/// The first option of a group that was given; empty if none was.
std::string first_given(const CLI::App& group);

/// Refuses an option that is given where it has no sense, for want of others. UserError
/// (bad_request).
void refuse_idle(bool is_given, const char* option, bool has_sense, const char* with);

}  // namespace misalign::search
