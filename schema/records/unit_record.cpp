#include "schema/records/unit_record.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace misalign::schema {

void UnitRecord::reject(solver::Fault fault, int sample) {
  ++rejected;
  ++screened[{static_cast<int>(fault), sample}];
}

void UnitRecord::turn_down(std::uint64_t draw, const solver::Verdict& verdict) {
  if (verdict.first_fault == solver::Fault::undecided) {
    undecided.push_back({draw, verdict});
  } else {
    reject(verdict.first_fault, verdict.fault_sample());
  }
}

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

void UnitRecord::add(UnitRecord&& next) {
  assert(range.hi == next.range.lo);
  range.hi = next.range.hi;
  accepted += next.accepted;
  rejected += next.rejected;
  seconds += next.seconds;
  tables_deg = std::max(tables_deg, next.tables_deg);
  const auto append = [](auto& to, auto& from) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  };
  append(candidates, next.candidates);
  append(undecided, next.undecided);
  append(fault_sample, next.fault_sample);
  append(levels, next.levels);
  for (const auto& [seen, draws] : next.screened) screened[seen] += draws;
}

}  // namespace misalign::schema
