// `misalign verify`: checks a catalogue against its own ledger, and computes what it holds again.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "search/checks/candidate_check.hpp"

namespace misalign::search {

struct VerifyOptions {
  /// So many candidates, and as many fault samples, spread evenly in the order of their draws; all
  /// of them without it.
  std::optional<std::uint64_t> sample = 100;
  /// So many units, of which every draw is made again.
  std::uint64_t units = 0;
  /// Of the choice of units, each of which is as likely as any other.
  std::uint64_t seed = 0;
};

struct CheckedCandidate {
  std::uint64_t draw;
  std::optional<double> first_contact_deg;
  std::string contact;  ///< the panels that cross
  schema::Json meet;    ///< as in ShapeReport
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
  Sample certificates;            ///< all of them: those that are as they were made
  std::uint64_t draws_again = 0;  ///< of those units
  std::uint64_t decided_now = 0;  ///< of those, undecided in the catalogue or here, not in both
  std::uint64_t seed = 0;         ///< that chose them
  std::vector<schema::Finding> findings;
  /// Candidates with metrics of another definition that differ, and those columns: no fault.
  std::uint64_t not_comparable = 0;
  std::set<std::string> other_definitions;
  /// Of all candidates that were checked.
  solver::ShapeCheck::Errors worst;
  double diagonal_mm = 0;

  std::uint64_t contacts() const;
  /// The one whose panels meet first at any angle; null if none do.
  const CheckedCandidate* first_meeting() const;
  /// The one whose panels cross first; null if none do.
  const CheckedCandidate* first_contact() const;
  /// That units made again show a candidate that was removed together with its sums: each unit is
  /// chosen with this probability.
  double chance_to_find_one() const;
  bool good() const { return findings.empty(); }
};

/// Checks the ledger as it is at one moment, then what was chosen of it: a row of the ledger never
/// changes, so that nothing need be held while paths are followed. UserError: bad_input if the
/// campaign's configuration cannot be read; failure and in_use see storage_failure.
Verification verify(SQLite::Database& database, const std::string& path,
                    const VerifyOptions& options);

std::string verification_text(const Verification& verification);
schema::Json verification_json(const Verification& verification);

}  // namespace misalign::search
