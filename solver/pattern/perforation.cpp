#include "solver/pattern/perforation.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::solver {
namespace {

// Largest number of steps in the search for perforations, each over all inner facets: seconds on
// the largest sheets.
constexpr int kMostSteps = 200'000;

// Enumerates sets of inner facets, with and without each facet in turn.
class SeparateFacets {
 public:
  SeparateFacets(const CreasePattern& sheet, int count, std::size_t most)
      : inner_(inner_facets(sheet)), count_(count), most_(most), blocked_(inner_.size(), 0) {
    neighbours_.resize(inner_.size());
    const auto number = [&](int f) {
      const auto at = std::lower_bound(inner_.begin(), inner_.end(), f);
      return at != inner_.end() && *at == f ? static_cast<int>(at - inner_.begin()) : -1;
    };
    for (const Edge& edge : sheet.edges) {
      const int i = number(edge.left), k = number(edge.right);
      if (i < 0 || k < 0) continue;
      neighbours_[i].push_back(k);
      neighbours_[k].push_back(i);
    }
  }

  std::optional<std::vector<std::vector<int>>> all() {
    if (count_ >= 0) extend(0);
    if (sets_.size() > most_ || steps_ > kMostSteps) return std::nullopt;
    return std::move(sets_);
  }

 private:
  void extend(int next) {
    if (static_cast<int>(chosen_.size()) == count_) {
      sets_.push_back(chosen_);
      return;
    }
    const int missing = count_ - static_cast<int>(chosen_.size());
    for (; next < static_cast<int>(inner_.size()); ++next) {
      if (sets_.size() > most_ || ++steps_ > kMostSteps || most_from(next) < missing) return;
      if (blocked_[next] > 0) continue;
      chosen_.push_back(inner_[next]);
      for (const int k : neighbours_[next]) ++blocked_[k];
      extend(next + 1);
      for (const int k : neighbours_[next]) --blocked_[k];
      chosen_.pop_back();
    }
  }

  // Upper bound of the facets still to be chosen: one of each pair of neighbours, every facet in at
  // most one pair.
  int most_from(int next) {
    paired_.assign(inner_.size(), false);
    int most = 0;
    for (int i = next; i < static_cast<int>(inner_.size()); ++i) {
      if (blocked_[i] > 0 || paired_[i]) continue;
      ++most;
      for (const int k : neighbours_[i]) {
        if (k < i || blocked_[k] > 0 || paired_[k]) continue;
        paired_[k] = true;
        break;
      }
    }
    return most;
  }

  const std::vector<int> inner_;
  const int count_;
  const std::size_t most_;
  std::vector<std::vector<int>> neighbours_;  // index: number of an inner facet, as below
  std::vector<int> blocked_;                  // chosen neighbours
  std::vector<bool> paired_;
  std::vector<int> chosen_;
  std::vector<std::vector<int>> sets_;
  int steps_ = 0;
};

}  // namespace

std::vector<int> inner_facets(const CreasePattern& sheet) {
  const std::vector<int> interior = interior_vertices(sheet);
  std::vector<int> inner;
  for (int f = 0; f < sheet.facet_count(); ++f) {
    const auto& corners = sheet.facets[f];
    if (std::all_of(corners.begin(), corners.end(), [&](int v) {
          return std::binary_search(interior.begin(), interior.end(), v);
        })) {
      inner.push_back(f);
    }
  }
  return inner;
}

std::vector<int> checkerboard(const CreasePattern& sheet, int remainder) {
  assert(remainder == 0 || remainder == 1);
  assert(sheet.places.size() == sheet.facets.size());
  std::vector<int> holes = inner_facets(sheet);
  std::erase_if(holes,
                [&](int f) { return (sheet.places[f][0] + sheet.places[f][1]) % 2 != remainder; });
  return holes;
}

int default_pilot(const CreasePattern& sheet, const std::vector<int>& holes) {
  assert(std::is_sorted(holes.begin(), holes.end()));
  const auto is_hole = [&](int f) { return std::binary_search(holes.begin(), holes.end(), f); };
  const auto first = std::find_if(sheet.edges.begin(), sheet.edges.end(), [&](const Edge& edge) {
    return !edge.on_perimeter() && !is_hole(edge.left) && !is_hole(edge.right);
  });
  return first == sheet.edges.end() ? -1 : static_cast<int>(first - sheet.edges.begin());
}

std::vector<std::string> hole_faults(const CreasePattern& sheet, const std::vector<int>& holes) {
  std::vector<bool> is_hole(sheet.facet_count(), false);
  assert(holes.empty() || (holes.front() >= 0 && holes.back() < sheet.facet_count()));
  for (const int f : holes) is_hole[f] = true;
  const auto name = [&](int f) {
    const auto& v = sheet.facets[f];
    return "the hole " + vertex_label(v[0]) + "-" + vertex_label(v[1]) + "-" + vertex_label(v[2]) +
           "-" + vertex_label(v[3]);
  };
  std::vector<std::string> faults;
  for (const Edge& edge : sheet.edges) {
    if (!edge.on_perimeter() && is_hole[edge.left] && is_hole[edge.right]) {
      faults.push_back(name(edge.left) + " shares the edge " + line_label(edge.a, edge.b) +
                       " with another hole");
    }
  }
  const std::vector<int> inner = inner_facets(sheet);
  for (const int f : holes) {
    if (!std::binary_search(inner.begin(), inner.end(), f)) {
      faults.push_back(name(f) + " lies on the perimeter");
    }
  }
  return faults;
}

int counted_mobility(const CreasePattern& sheet, const std::vector<int>& holes) {
  const int joints = sheet.vertex_count();
  const int kept = sheet.facet_count() - static_cast<int>(holes.size());
  const int members = static_cast<int>(sheet.edges.size()) + 2 * kept;
  return 3 * joints - (members + 6);
}

int holes_that_count_to_one(const CreasePattern& sheet) {
  const int lacking = 1 - counted_mobility(sheet, {});  // each hole gives two back
  return lacking >= 0 && lacking % 2 == 0 ? lacking / 2 : -1;
}

std::optional<std::vector<std::vector<int>>> separate_facets(const CreasePattern& sheet, int count,
                                                             std::size_t most) {
  return SeparateFacets(sheet, count, most).all();
}

}  // namespace misalign::solver
