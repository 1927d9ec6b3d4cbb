#include "schema/kit/kit_parts.hpp"

#include <algorithm>
#include <limits>

#include "solver/pattern/outline.hpp"

namespace misalign::schema {
namespace {

// Parts of `facets`: panels that creases join for which `joins` is true.
template <class Joins>
std::vector<KitPart> joined(const solver::Sheet& sheet, const std::vector<int>& facets,
                            const Joins& joins) {
  std::vector<int> leader(static_cast<std::size_t>(sheet.base().sheet.facet_count()), -1);
  for (const int f : facets) leader[static_cast<std::size_t>(f)] = f;
  const auto leader_of = [&](int f) {
    while (leader[static_cast<std::size_t>(f)] != f) f = leader[static_cast<std::size_t>(f)];
    return f;
  };
  const auto& creases = sheet.mechanism().creases;
  const auto is_inside = [&](const solver::Crease& crease) {
    return leader[static_cast<std::size_t>(crease.left)] >= 0 &&
           leader[static_cast<std::size_t>(crease.right)] >= 0 && joins(crease);
  };
  for (const solver::Crease& crease : creases) {
    if (!is_inside(crease)) continue;
    const auto [low, high] = std::minmax({leader_of(crease.left), leader_of(crease.right)});
    leader[static_cast<std::size_t>(high)] = low;
  }
  std::vector<KitPart> part_of_leader(leader.size()), parts;
  for (const int f : facets) {
    part_of_leader[static_cast<std::size_t>(leader_of(f))].facets.push_back(f);
  }
  for (std::size_t c = 0; c < creases.size(); ++c) {
    if (!is_inside(creases[c])) continue;
    part_of_leader[static_cast<std::size_t>(leader_of(creases[c].left))].creases.push_back(
        static_cast<int>(c));
  }
  for (KitPart& part : part_of_leader) {
    if (!part.facets.empty()) parts.push_back(std::move(part));
  }
  std::stable_sort(parts.begin(), parts.end(), [](const KitPart& a, const KitPart& b) {
    return a.facets.size() > b.facets.size();
  });
  return parts;
}

struct Span {
  int least = std::numeric_limits<int>::max(), most = std::numeric_limits<int>::min();
  void add(int value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  int count() const { return most - least + 1; }
  // The index of a value among `cells` about equal ranges.
  int cell(int value, int cells) const { return (value - least) * cells / count(); }
};

std::array<Span, 2> spans(const solver::Sheet& sheet, const KitPart& part) {
  std::array<Span, 2> span;
  for (const int f : part.facets) {
    const auto& place = sheet.base().sheet.places[static_cast<std::size_t>(f)];
    for (std::size_t k = 0; k < 2; ++k) span[k].add(place[k]);
  }
  return span;
}

}  // namespace

std::vector<KitPart> kit_parts(const solver::Sheet& sheet, CreaseCut crease) {
  return joined(sheet, solver::kept_facets(sheet.base().sheet, sheet.base().holes),
                [&](const solver::Crease&) { return !are_apart(crease); });
}

std::vector<KitPart> divided(const solver::Sheet& sheet, const KitPart& part, int down,
                             int across) {
  const auto [rows, columns] = spans(sheet, part);
  const auto cell = [&, &rows = rows, &columns = columns](int f) {  // clang 14 takes no bindings
    const auto& [row, column] = sheet.base().sheet.places[static_cast<std::size_t>(f)];
    return rows.cell(row, down) * across + columns.cell(column, across);
  };
  return joined(sheet, part.facets, [&](const solver::Crease& crease) {
    return cell(crease.left) == cell(crease.right);
  });
}

std::array<int, 2> rows_and_columns(const solver::Sheet& sheet, const KitPart& part) {
  const auto [rows, columns] = spans(sheet, part);
  return {rows.count(), columns.count()};
}

}  // namespace misalign::schema
