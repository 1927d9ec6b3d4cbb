// Makes the proposals of the Markov kernel. Each is as likely as its reverse, so that a particle
// that accepts proposals within its level, and stays otherwise, keeps the plain distribution on
// that level (Metropolis et al., J. Chem. Phys. 21, 1953).
#pragma once

#include <array>

#include "search/splitting/particles.hpp"
#include "solver/pattern/symmetry.hpp"

namespace misalign::search {

/// Random words of a particle at one step of a level; step 0 makes it, the others move it. Philox
/// stream 3: counter = (population, particle, step and block, level and stream), sixteen bits each
/// of step and block, and eight of the stream.
class StepWords {
 public:
  static constexpr std::uint32_t kMostSteps = 0xFFFF, kMostLevels = 0xFFFFFF;

  StepWords(std::uint64_t seed, std::uint32_t population, std::uint32_t level, std::uint32_t step,
            std::uint32_t particle);
  std::uint32_t next();
  /// Returns a number below `count`, uniform up to one part in 2^32 / count.
  std::size_t next_below(std::size_t count);

 private:
  std::uint64_t seed_, counter_low_;
  std::uint32_t step_, stream_;
  std::uint32_t used_ = 0;
  std::array<std::uint32_t, 4> block_{};
};

class Moves {
 public:
  Moves(const schema::Campaign& campaign);

  /// Makes a plain draw.
  void draw(StepWords words, ShiftCode::Particle sheet) const;
  /// Replaces `sheet` with a proposal: one in sixteen is a mirror image, if the sheet has
  /// symmetries; otherwise one shift is redrawn, two half as often, and so forth.
  void propose(StepWords words, ShiftCode::Particle sheet) const;

  const ShiftCode& code() const { return code_; }

 private:
  void mirror(const solver::ShiftSymmetry& symmetry, ShiftCode::Particle sheet) const;

  ShiftCode code_;
  std::vector<solver::ShiftSymmetry> symmetries_;
};

}  // namespace misalign::search
