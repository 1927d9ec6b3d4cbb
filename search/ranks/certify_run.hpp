// `misalign certify` on a catalogue: certificates of its candidates, alone or under mpirun.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "schema/records/certificate_record.hpp"
#include "search/terminal/failure.hpp"

namespace misalign::search {

/// What rank 0 knows in the end.
struct CertifyReport {
  std::vector<schema::NamedCertificate> sheets;  ///< in their order; none of a check
  std::uint64_t left = 0;                        ///< not done, because a signal asked to stop
  schema::CertificateCheck check;
};

struct CertifyOptions {
  Border border;
  std::string path;
  std::function<std::vector<std::uint64_t>(SQLite::Database&)> choose;  ///< the draws
  std::optional<double> to_deg;  ///< instead of the design's angle of use, or each D
  bool contact = false;          ///< also that no panels meet
  bool again = false;            ///< those anew that have a certificate already
  bool alone_is_meant = false;   ///< also where other tasks were started beside it
  bool check = false;            ///< none is made: those that there are, are checked
  std::function<void(const CertifyReport&)> show;  ///< is called on rank 0 once all is stored
};

/// Returns the exit code.
int run_certify(const CertifyOptions& options);

}  // namespace misalign::search
