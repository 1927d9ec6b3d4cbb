// Catalogues with as many rows as a very large campaign makes, written by SQL, and what the program
// then needs to open, resume and report them.
#pragma once

#include <cstdint>
#include <string>

namespace misalign::bench {

struct LedgerSize {
  std::uint64_t draws;       ///< of the campaign
  std::uint64_t unit_draws;  ///< of a unit
  double missing;            ///< this share of the units is not there, at random
  std::uint64_t sampled;  ///< rows of fault_sample, from draw 0 on every 1024, as before schema 4
};

struct LedgerTimes {
  std::uint64_t units, gaps, bytes;
  double open_s;                       ///< Catalogue: lock, campaign compared, statements prepared
  double done_s;                       ///< Catalogue::done
  double ledger_s;                     ///< Ledger from it
  double begin_run_s;                  ///< goal and run stored
  double status_s;                     ///< read_state, the second time
  double status_with_file_uncached_s;  ///< the first time, nothing of the file in memory
  double resume_mb, status_mb;         ///< resident memory that each added, at its highest
};

/// In `folder`, removed afterwards.
LedgerTimes time_large_ledger(const std::string& folder, const LedgerSize& size);

}  // namespace misalign::bench
