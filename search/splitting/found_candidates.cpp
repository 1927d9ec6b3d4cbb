#include "search/splitting/found_candidates.hpp"

#include <utility>

#include "schema/files/hash.hpp"

namespace misalign::search {

FoundCandidates::Print FoundCandidates::print_of(const schema::Candidate& candidate) {
  const Eigen::Matrix2Xd& shifts_mm = candidate.shifts_mm;
  const std::size_t bytes = sizeof(double) * static_cast<std::size_t>(shifts_mm.size());
  const XXH128_hash_t hash =
      schema::hash_of({reinterpret_cast<const char*>(shifts_mm.data()), bytes});
  return {hash.low64, hash.high64};
}

void FoundCandidates::add(const Origin& origin, schema::Candidate candidate) {
  const auto [first, is_new] = first_.try_emplace(print_of(candidate), origin);
  if (!is_new) {
    if (first->second <= origin) return;
    kept_.erase(first->second);
    first->second = origin;
  }
  kept_.emplace(origin, std::move(candidate));
  if (kept_.size() > most_) kept_.erase(std::prev(kept_.end()));
}

void FoundCandidates::count(std::vector<schema::LevelCount>& levels) const {
  for (const auto& [print, origin] : first_) ++levels[origin.level].met;
}

std::vector<FoundCandidate> FoundCandidates::take() {
  std::vector<FoundCandidate> found;
  found.reserve(kept_.size());
  for (auto& [origin, candidate] : std::exchange(kept_, {})) {
    found.push_back({origin, std::move(candidate)});
  }
  return found;
}

}  // namespace misalign::search
