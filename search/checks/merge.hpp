// Runs `misalign merge`, which joins catalogues of one campaign.
#pragma once

#include <string>
#include <vector>

#include "schema/catalogue/catalogue.hpp"
#include "schema/catalogue/ledger_check.hpp"

namespace misalign::search {

struct MergeOptions {
  std::string output;  ///< must not exist yet
  std::vector<std::string> inputs;
  schema::RunInfo run;  ///< the joining program, which also computes missing units
  schema::Builds builds = schema::Builds::same;
};

struct MergeReport {
  std::size_t units = 0;         ///< units copied unchanged
  std::uint64_t compared = 0;    ///< draws that several catalogues had
  std::uint64_t recomputed = 0;  ///< draws of units that overlap others in part
  std::uint64_t decided = 0;     ///< draws left undecided in one catalogue and decided in another
  /// Certificates that were not copied, since they have changed.
  std::uint64_t faulty_certificates = 0;
  /// Differences between catalogues, or faults in one: then nothing is written.
  std::vector<schema::Finding> findings;
};

/// Writes the whole output or none. Overlapping units are compared: displacements and samples
/// exactly, metrics within ColumnTolerances. UserError: bad_request if the output exists, bad_input
/// and foreign as for opening a catalogue, bad_input if one is damaged, foreign if campaigns or
/// builds differ.
MergeReport merge(const MergeOptions& options);

}  // namespace misalign::search
