// `misalign verify`: a catalogue against its own ledger, and its candidates computed again.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "search/candidate_check.hpp"

namespace misalign::search {

struct CheckedCandidate {
  std::uint64_t draw;
  std::optional<double> first_contact_deg;
  std::string contact;  ///< the panels that cross
};

struct Verification {
  std::string campaign, digest;
  std::uint64_t candidates = 0;
  std::vector<CheckedCandidate> checked;
  std::vector<schema::Finding> findings;
  /// Of all candidates that were checked.
  solver::ShapeErrors worst;
  double diagonal_mm = 0;

  std::uint64_t contacts() const;
  /// The one whose panels cross first; null if none do.
  const CheckedCandidate* first_contact() const;
  bool good() const { return findings.empty(); }
};

/// Checks the ledger, and `sample` candidates spread evenly over them in the order of their draws;
/// all of them without it. UserError: 3 if the campaign's configuration cannot be read.
Verification verify(SQLite::Database& database, const std::string& path,
                    std::optional<std::uint64_t> sample);

std::string verification_text(const Verification& verification);
schema::Json verification_json(const Verification& verification);

}  // namespace misalign::search
