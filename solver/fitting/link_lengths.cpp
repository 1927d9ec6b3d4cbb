#include "solver/fitting/link_lengths.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <set>

namespace misalign::solver {
namespace {

constexpr int kMostSets = 20000;

using Picks = std::vector<StockPick>;

class LinkSearch {
 public:
  LinkSearch(const StockDrive& drive, Picks picks) : drive_(drive), picks_(std::move(picks)) {}

  Picks run() {
    std::set<int> present;
    for (const StockPick& pick : picks_) present.insert(pick.link);
    const std::vector<int> lengths(present.begin(), present.end());
    for (std::size_t count = 1; count < lengths.size(); ++count) {
      if (try_sets(lengths, count)) break;
    }
    while (weaken()) {
    }
    return picks_;
  }

 private:
  // The least that springs overcome beyond the demand.
  double spare(const Picks& picks) const {
    return (drive_.gains(picks) - drive_.demand()).minCoeff();
  }

  // Each spring with the nearest length of a set that it can have; none where one can have none.
  std::optional<Picks> with_lengths(const std::vector<int>& lengths) const {
    Picks changed;
    for (StockPick pick : picks_) {
      const LinkRange range = drive_.links(pick.diagonal, pick.type);
      std::optional<int> nearest;
      for (const int length : lengths) {
        if (!range.contains(length)) continue;
        if (!nearest || std::abs(length - pick.link) < std::abs(*nearest - pick.link)) {
          nearest = length;
        }
      }
      if (!nearest) return {};
      pick.link = *nearest;
      changed.push_back(pick);
    }
    return changed;
  }

  // Keeps the set of `count` lengths that overcomes most, if one overcomes the demand.
  bool try_sets(const std::vector<int>& lengths, std::size_t count) {
    std::vector<bool> is_in(lengths.size());
    std::fill(is_in.end() - static_cast<std::ptrdiff_t>(count), is_in.end(), true);
    Picks best;
    double most = 0;
    do {
      if (++sets_ > kMostSets) break;
      std::vector<int> set;
      for (std::size_t k = 0; k < lengths.size(); ++k) {
        if (is_in[k]) set.push_back(lengths[k]);
      }
      const auto changed = with_lengths(set);
      if (!changed) continue;
      const double left = spare(*changed);
      if (left < most || (left == most && !best.empty())) continue;
      most = left;
      best = *changed;
    } while (std::next_permutation(is_in.begin(), is_in.end()));
    if (best.empty()) return sets_ > kMostSets;
    picks_ = std::move(best);
    return true;
  }

  // Makes all links of one length a step weaker where the demand is still overcome.
  bool weaken() {
    std::set<int> lengths;
    for (const StockPick& pick : picks_) lengths.insert(pick.link);
    bool is_changed = false;
    for (const int length : lengths) {
      Picks changed = picks_;
      bool may = true;
      for (StockPick& pick : changed) {
        if (pick.link != length) continue;
        pick.link += drive_.pulls(pick.type) ? 1 : -1;
        may = may && drive_.links(pick.diagonal, pick.type).contains(pick.link);
      }
      if (!may || spare(changed) < 0) continue;
      picks_ = std::move(changed);
      is_changed = true;
    }
    return is_changed;
  }

  const StockDrive& drive_;
  Picks picks_;
  int sets_ = 0;
};

}  // namespace

std::vector<StockPick> with_few_links(const StockDrive& drive,
                                      const std::vector<StockPick>& picks) {
  return LinkSearch(drive, picks).run();
}

}  // namespace misalign::solver
