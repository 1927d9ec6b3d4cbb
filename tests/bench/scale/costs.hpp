// Costs of rank 0, measured with the program's own catalogue, messages and trial on this machine.
#pragma once

#include <string>
#include <vector>

namespace misalign::bench {

/// Something that grows with what a unit holds: fixed (per call), and each unit, candidate and
/// sampled draw.
struct UnitCost {
  double fixed = 0, unit = 0, candidate = 0, sampled = 0;

  double of(double units, double candidates, double samples) const {
    return fixed + unit * units + candidate * candidates + sampled * samples;
  }
};

/// How long rank 0's blocks of draws of its own (UnitWork::run_next_block) keep it from its
/// messages.
struct BlockTimes {
  double threshold_deg;  ///< of miura-6x6
  double draws_per_s;
  double mean_wait_s;  ///< of something that comes at any time: mean square over twice the mean
  std::vector<double> quantiles_s;  ///< evenly spaced
};

struct Costs {
  UnitCost commit_s;       ///< Catalogue::commit, log and checkpoints included
  UnitCost unpack_s;       ///< unpack_unit, by unit
  UnitCost message_bytes;  ///< of a packed unit
  UnitCost row_bytes;      ///< in the catalogue's file
  double unit_start_s;     ///< what a unit takes on a worker however few its draws
  BlockTimes fast, slow;   ///< of a campaign with hardly any accepted draws, and with mostly those
};

/// Writes a catalogue of some hundred MB in `folder` and removes it.
Costs measure_costs(const std::string& folder);

}  // namespace misalign::bench
