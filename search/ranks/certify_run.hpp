// Runs `misalign certify` on a catalogue: certificates of its candidates, alone or under mpirun.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "schema/records/certificate_record.hpp"
#include "search/terminal/failure.hpp"
#include "solver/records/certificate.hpp"

namespace misalign::search {

/// Rank 0's results.
struct CertifyReport {
  std::vector<schema::NamedCertificate>
      sheets;              ///< certificates in the draws' order; empty after a check
  std::uint64_t left = 0;  ///< not done because of a signal
  schema::CertificateCheck check;
};

struct CertifyOptions {
  Border border;
  std::string path;
  std::function<std::vector<std::uint64_t>(SQLite::Database&)> choose;  ///< the draws
  std::optional<double> to_deg;                  ///< replaces the design's angle of use, or each D
  bool contact = false;                          ///< certify also that no panels meet
  std::optional<solver::CertifiedBy> criterion;  ///< replaces that of the campaign's criterion
  bool again = false;                            ///< renew existing certificates
  bool alone_is_meant = false;                   ///< allow one rank beside other started tasks
  bool check = false;                            ///< check the existing certificates, make none
  std::function<void(const CertifyReport&)> show;  ///< called on rank 0 once all is stored
};

/// Returns the exit code.
int run_certify(const CertifyOptions& options);

}  // namespace misalign::search
