// `misalign merge`: joins catalogues of one campaign.
#pragma once

#include <string>
#include <vector>

#include "schema/catalogue/catalogue.hpp"
#include "schema/catalogue/ledger_check.hpp"

namespace misalign::search {

struct MergeOptions {
  std::string output;  ///< must not exist yet
  std::vector<std::string> inputs;
  schema::RunInfo run;  ///< of this program: who joined them, and computed what was missing
  schema::Builds builds = schema::Builds::same;
};

struct MergeReport {
  std::size_t units = 0;         ///< taken as they are
  std::uint64_t compared = 0;    ///< draws that several catalogues had
  std::uint64_t recomputed = 0;  ///< draws of units that overlap others in part
  std::uint64_t decided = 0;     ///< draws that one had left undecided and another had not
  /// Certificates that were not taken: they are not as they were made.
  std::uint64_t faulty_certificates = 0;
  /// What catalogues disagree about, or what is wrong within one: then nothing is written.
  std::vector<schema::Finding> findings;
};

/// Writes the whole output or none. Units that overlap others are compared with them: displacements
/// and samples exactly, metrics within ColumnTolerances. UserError: bad_request the output exists,
/// bad_input and foreign as for opening a catalogue, bad_input if one is damaged, foreign if they
/// are of different campaigns or builds.
MergeReport merge(const MergeOptions& options);

}  // namespace misalign::search
