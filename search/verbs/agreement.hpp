// `misalign bench --agree` and `--rejections`: every verdict of the fast path beside the frozen
// reference's, and every rejection beside the full path's verdict.
#pragma once

#include <vector>

#include "schema/campaign/campaign.hpp"
#include "solver/lanes/batch.hpp"

namespace misalign::search {

/// Verdicts of the fast path against the reference's, or decisions against full paths, on draws
/// from 0 on.
struct AgreementReport {
  std::uint64_t draws = 0, undecided = 0;
  std::uint64_t verdicts_differ = 0;   // D, first fault or place, on the full path
  std::uint64_t reference_jumped = 0;  // they differed until the reference grew into its start, or
                                       // took finer steps
  std::uint64_t reference_lost = 0;    // not compared: it is undecided, and the fast path is not
  std::uint64_t decisions = 0;  // at the campaign's threshold, at every tenth degree, at each
                                // draw's D and one sample above
  std::uint64_t decisions_differ = 0;
  std::vector<std::uint64_t> differing_draws;  // the first few
};

/// The expected side of a comparison.
enum class Against { reference, full_path };

/// Compares one instruction set with the expected side.
AgreementReport compare(const schema::Campaign& campaign, solver::InstructionSet set,
                        std::uint64_t draws, Against against);

schema::Json report_json(const AgreementReport& report);
void print_agreement(const AgreementReport& report, Against against);

}  // namespace misalign::search
