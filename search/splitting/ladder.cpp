#include "search/splitting/ladder.hpp"

namespace misalign::search {

PieceOrder order_of(std::uint32_t population, std::uint32_t level,
                    const schema::DrawRange& particles, const RungBounds& bounds,
                    const ScoredParticles& scored) {
  PieceOrder order{population,
                   level,
                   static_cast<std::uint32_t>(particles.lo),
                   static_cast<std::uint32_t>(particles.hi),
                   bounds.within,
                   bounds.next,
                   scored.count() == 0,
                   true,
                   {}};
  if (order.is_first) return order;
  order.here.reserve(particles.size(), scored.sheets.bytes_each);
  for (std::uint64_t k = particles.lo; k < particles.hi; ++k) order.here.add(scored, k);
  return order;
}

// Selection sampling (Knuth, The Art of Computer Programming 2, 3.4.2, algorithm S).
std::vector<std::uint32_t> copies_of_survivors(std::uint64_t seed, std::uint32_t population,
                                               std::uint32_t level, std::uint32_t survivors,
                                               std::uint32_t particles) {
  std::vector<std::uint32_t> copies;
  copies.reserve(particles);
  std::uint32_t extra = particles % survivors;  // still to be chosen
  for (std::uint32_t k = 0; k < survivors; ++k) {
    copies.insert(copies.end(), particles / survivors, k);
    StepWords words(seed, population, level, 0, k);
    if (words.next_below(survivors - k) >= extra) continue;
    copies.push_back(k);
    --extra;
  }
  return copies;
}

}  // namespace misalign::search
