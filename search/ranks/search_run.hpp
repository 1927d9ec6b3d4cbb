// Runs `misalign search`: from campaign file to catalogue, alone or under mpirun.
#pragma once

#include <optional>
#include <string>

#include "search/draws/draw_evaluator.hpp"
#include "search/ranks/coordinator.hpp"
#include "search/terminal/failure.hpp"

namespace misalign::search {

struct SearchOptions {
  Border border;
  Parts parts;
  std::string campaign_path;
  std::string catalogue_path;  ///< empty: results/NAME-<8 hex digits>.db
  std::optional<std::uint64_t> draws, populations, accepted, seed;
  std::optional<double> max_time_s, relative_error;
  std::optional<schema::DrawRange> range;
  std::optional<std::uint64_t> unit_draws;
  std::size_t unit_bytes = kMostUnit_bytes;
  ProgressStyle progress = ProgressStyle::automatic;
  std::optional<schema::Storage> storage;  ///< replaces the file system's kind
  schema::Builds builds = schema::Builds::same;
  bool retry_undecided = false;
  bool alone_is_meant = false;  ///< allow one rank beside other started tasks
  std::string command_for_all;  ///< the command that uses every core, if this one does not
  solver::InstructionSet instruction_set = solver::available_instruction_sets().back();
};

/// Runs or resumes the campaign; returns the exit code.
int run_search(const SearchOptions& options);

/// Returns "results/miura-6x6-1a2b3c4d.db".
std::string default_catalogue_path(const schema::Campaign& campaign);

}  // namespace misalign::search
