#include "schema/records/unit_record.hpp"

namespace misalign::schema {

std::vector<std::uint64_t> UnitRecord::accepted_draws() const {
  std::vector<std::uint64_t> draws;
  for (const Candidate& candidate : candidates) draws.push_back(candidate.draw);
  return draws;
}

std::vector<std::uint64_t> UnitRecord::undecided_draws() const {
  std::vector<std::uint64_t> draws;
  for (const DrawVerdict& draw : undecided) draws.push_back(draw.draw);
  return draws;
}

}  // namespace misalign::schema
