// The options of a kit to cut.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <optional>
#include <string>

#include "schema/kit/kit_options.hpp"

namespace misalign::search {

struct KitCall {
  bool wanted = false;
  schema::KitOptions options;  ///< all but the crease
  std::optional<schema::CreaseCut> crease;
  std::string bed;              ///< "600x400"
  schema::PlateOptions plates;  ///< typed numbers
  std::optional<double> barrel_mm, clearance_mm, bore_edge_mm;
};

/// Adds --kit, and the options that need it.
void add_kit(CLI::App& verb, KitCall& call);
inline constexpr std::array kKitOptions = {
    "--crease",     "--dash-mm", "--kerf",   "--joint-bore", "--spring-bore", "--spring-at",
    "--bore-edge",  "--gap",     "--bed",    "--margin",     "--bond",        "--guide",
    "--test-piece", "--grain",   "--units",  "--barrel",     "--clearance",   "--allow-misfit",
    "--pin",        "--slot",    "--spacer", "--ball"};

/// The kit with the design's kind of hinge, its plates where that is one of plates, and the bed if
/// one is given; none without --kit. Without a thickness hinges of the design are those of cut
/// creases. UserError (bad_request) where --crease names plates that have no thickness.
std::optional<schema::KitOptions> chosen_kit(const KitCall& call, const schema::Design& design);

}  // namespace misalign::search
