// Runs `misalign verify`: checks a catalogue against its ledger, and computes its contents again.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "search/checks/candidate_check.hpp"
#include "search/checks/memory_check.hpp"

namespace misalign::search {

struct VerifyOptions {
  /// Number of candidates, of fault samples and of remembered numbers, spread evenly over the
  /// draws; null for all.
  std::optional<std::uint64_t> sample = 100;
  /// Number of units whose draws are all made again.
  std::uint64_t units = 0;
  /// Random seed of the choice of units, each with equal probability.
  std::uint64_t seed = 0;
};

struct CheckedCandidate {
  std::uint64_t draw;
  std::optional<double> first_contact_deg;
  std::string contact;  ///< the panels that cross
  schema::Json meet;    ///< see ShapeReport
  double met_until_deg;
  std::string meet_text;
};

struct Verification {
  struct Sample {
    std::uint64_t checked = 0, of = 0;
  };
  std::string campaign, digest;
  std::uint64_t candidates = 0;
  std::vector<CheckedCandidate> checked;
  Sample fault_samples, units;
  Sample certificates;            ///< unchanged certificates, among all
  MemoryReport memory;            ///< remembered numbers of studies
  std::uint64_t draws_again = 0;  ///< draws of those units
  std::uint64_t decided_now = 0;  ///< draws undecided either in the catalogue or now
  std::uint64_t seed = 0;         ///< random seed of the choice
  std::vector<schema::Finding> findings;
  /// Candidates that differ in metrics of another definition, which is no fault; then these
  /// columns.
  std::uint64_t not_comparable = 0;
  std::set<std::string> other_definitions;
  /// Largest errors of all checked candidates.
  solver::ShapeCheck::Errors worst;
  double diagonal_mm = 0;

  std::uint64_t contacts() const;
  /// Returns the candidate whose panels meet first at any angle; null if none do.
  const CheckedCandidate* first_meeting() const;
  /// Returns the candidate whose panels cross first; null if none do.
  const CheckedCandidate* first_contact() const;
  /// Returns the probability that a unit is chosen: that of finding a candidate that was removed
  /// together with its sums.
  double chance_to_find_one() const;
  bool good() const { return findings.empty(); }
};

/// Checks the ledger at one moment, then the chosen rows: they never change, so that no lock is
/// held while paths are followed. UserError: bad_input if the campaign's configuration cannot be
/// read; failure and in_use see storage_failure.
Verification verify(SQLite::Database& database, const std::string& path,
                    const VerifyOptions& options);

}  // namespace misalign::search
