// Rejects draws before anything is solved, by what their shifts do to the diagonals to second order
// (a ShiftExpansion). Makes the expansion as well: its gradients are those of sheets with one
// coordinate shifted, by the adjoint of the loop closure; its bounds come from drawn sheets.
#pragma once

#include <cstring>
#include <memory>

#include "solver/lanes/level_solver.hpp"
#include "solver/lanes/product_sums.hpp"
#include "solver/model/flat_gradient.hpp"
#include "solver/model/shift_expansion.hpp"

namespace misalign::solver {

// Sheets of the sample on which tables are measured; sheets for which each part of the tables is
// loaded into the cache once.
constexpr int kSampleSheets = 1024, kSheetsAtOnce = 1024;
// Memory that tables may take of a rank.
constexpr std::size_t kMostTableBytes = 16 << 20;
// Tables must reject at least this share of the sample, and its verdict must be known for at least
// kLeastKnown of it.
constexpr double kLeastTurnedAway = 0.1;
constexpr double kLeastKnown = 0.9;
// Late levels, of 180 degrees, in proportion where the base folding ends earlier: the first that
// turns away enough, or the one that turns away most. The early one is in proportion to it.
constexpr double kLate_deg[] = {130, 140, 115}, kEnoughTurnedAway = 0.75, kEarlyShare = 0.12;

/// T is a register of doubles, Single one of floats.
template <class T, class Single>
class ExpansionTest {
 public:
  /// Makes no expansion under the energy criterion, where shifts are not ternary, tables would be
  /// too large, or too few sheets could be turned away.
  explicit ExpansionTest(const Model& model);

  bool is_there() const { return expansion_ != nullptr; }
  /// The tables; only where they are there.
  const ShiftExpansion& expansion() const { return *expansion_; }

  /// Pilot angles of the base folding at the two levels, and the share of a sample that tables
  /// reject.
  double early_deg() const { return kEarlyShare * late_deg_; }
  double late_deg() const { return late_deg_; }
  double turned_away() const { return turned_away_; }

  /// Passes all that is certain of each sheet of the block to `rules` (a RejectionTest).
  template <class Rules>
  void run(const ShiftBlock& block, Rules& rules);

 private:
  using Short = ShiftExpansion::Short;
  // A vector is as long as a register of T, but no longer than a row.
  static constexpr int kRow = ShiftExpansion::kRow, kSums = ShiftExpansion::kSums;
  static constexpr int kBytes = std::min<int>(sizeof(T), kRow * sizeof(Short));
  using Shorts [[gnu::vector_size(kBytes), gnu::aligned(2), gnu::may_alias]] = Short;
  static constexpr int kPieces = kRow * static_cast<int>(sizeof(Short)) / kBytes;

  double make_ready(const Model& model, double late_deg);
  double calibrate(const ShiftExpansion::Sample& sample);
  void find_gradients(const Model& model, const ShiftPlaces& places, ShiftGradients& gradients);
  void find_sample(const Model& model, const ShiftPlaces& places, ShiftExpansion::Sample& sample);
  void look_at(const ShiftBlock& block, int first, int count);
  void add_up(int group);

  std::unique_ptr<ShiftExpansion> expansion_;
  const double amplitude_mm_;
  double late_deg_ = 0, turned_away_ = 0;
  int late_sample_ = 0;
  ProductSums products_{sizeof(T)};
  // Numbers of the sheets that are tested, and their sums; then the table rows of their vertices
  // and the signs of their coordinates.
  std::vector<int> asked_;
  std::vector<Short> sums_;
  std::vector<std::uint16_t> rows_;
  std::vector<signed char> signs_;
  std::vector<signed char> directions_;
};

template <class T, class Single>
ExpansionTest<T, Single>::ExpansionTest(const Model& model) : amplitude_mm_(model.ternary_mm()) {
  const int vertices = static_cast<int>(model.shifted().size());
  // Springs beside the vertices elongate in unshifted sheets too: expansions have no such term.
  // The rules of the expansion are those of monotone diagonals.
  if (model.criterion().energy || model.ternary_mm() <= 0 || vertices == 0 ||
      model.tests().empty() || !model.mechanism().springs.at_vertices() ||
      model.sample_deg() > kRejection.longest_sample_for_slopes_deg ||
      2 * vertices > ProductTable::kMostCoordinates ||
      ShiftExpansion::bytes(vertices, model.mechanism().diagonal_count()) > kMostTableBytes) {
    return;
  }
  const double farthest_deg = model.tests()[0].pilot_deg;
  double made_deg = 0;
  for (const double wanted_deg : kLate_deg) {
    const double deg = std::min(wanted_deg / 180 * model.base().folding.end_deg(), farthest_deg);
    if (deg == made_deg || turned_away_ >= kEnoughTurnedAway) continue;
    const double turned_away = make_ready(model, made_deg = deg);
    if (turned_away < std::max(turned_away_, kLeastTurnedAway)) continue;
    turned_away_ = turned_away;
    late_deg_ = deg;
  }
  if (late_deg_ == 0) {
    expansion_.reset();
  } else if (late_deg_ != made_deg) {
    make_ready(model, late_deg_);
  }
  late_sample_ = static_cast<int>(late_deg_ / model.sample_deg());
}

// Returns the share of a sample's sheets that the tables reject.
template <class T, class Single>
double ExpansionTest<T, Single>::make_ready(const Model& model, double late_deg) {
  const ShiftPlaces places(model, kEarlyShare * late_deg, late_deg);
  ShiftGradients gradients(model);
  find_gradients(model, places, gradients);
  expansion_ = std::make_unique<ShiftExpansion>(gradients);
  ShiftExpansion::Sample sample(model, kSampleSheets);
  find_sample(model, places, sample);
  const auto known = static_cast<double>(std::ranges::count(sample.is_known, 1));
  return known < kLeastKnown * kSampleSheets ? 0 : calibrate(sample);
}

template <class T, class Single>
double ExpansionTest<T, Single>::calibrate(const ShiftExpansion::Sample& sample) {
  std::vector<char> both(static_cast<std::size_t>(sample.block.sheets));
  signed char directions[ShiftExpansion::kDiagonals];
  look_at(sample.block, 0, sample.block.sheets);
  for (int group = 0; group < expansion_->groups(); ++group) {
    add_up(group);
    expansion_->calibrate(group, sums_, sample);
    for (std::size_t s = 0; s < both.size(); ++s) {
      both[s] |= expansion_->see(group, sums_.data() + s * kSums, directions);
    }
  }
  return static_cast<double>(std::ranges::count(both, 1)) / sample.block.sheets;
}

// Gradients of the lengths at the early angle and on both sides of the late one: elongations are
// lengths less flat ones.
template <class T, class Single>
void ExpansionTest<T, Single>::find_gradients(const Model& model, const ShiftPlaces& places,
                                              ShiftGradients& gradients) {
  const Mechanism& mechanism = model.mechanism();
  const double amplitude = model.ternary_mm() / mechanism.panel_width_mm;
  const double per_step = amplitude / (2 * ShiftPlaces::kHalfStep_deg * kRadPerDeg);
  const struct {
    int place;
    ShiftedQuantity quantity;
    double share;
  } looks[] = {{ShiftPlaces::kEarly, ShiftedQuantity::elongation, amplitude},
               {ShiftPlaces::kBefore, ShiftedQuantity::slope, -per_step},
               {ShiftPlaces::kAfter, ShiftedQuantity::slope, per_step}};
  LevelSolver<T> solver(model, places.all);
  FlatGradient<T> gradient(mechanism);
  std::vector<T> row(static_cast<std::size_t>(2 * mechanism.vertices), T(0)),
      level(static_cast<std::size_t>(mechanism.unknowns), T(0));
  for (int first = 0; first < gradients.sheets().sheets; first += kLanes<T>) {
    const int count = std::min(kLanes<T>, gradients.sheets().sheets - first);
    solver.load(gradients.sheets(), first, count);
    for (const auto& [place, quantity, share] : looks) {
      solver.solve(place);
      gradient.at(solver.geometry(), solver.state());
      for (std::size_t j = 0; j < level.size(); ++j) level[j] = T(places.all[place].level[j]);
      for (int d = 0; d < mechanism.diagonal_count(); ++d) {
        gradient.with_level_held(d, solver.factors(), level, solver.tangent(), row);
        if (quantity == ShiftedQuantity::elongation) {
          add_flat_length(mechanism, solver.geometry(), mechanism.diagonals[d], T(-1), row.data());
        }
        for (int j = 0; j < gradients.coordinates(); ++j) {
          const T& entry = row[2 * model.shifted()[j / 2] + j % 2];
          for (int i = 0; i < count; ++i) {
            gradients.add(quantity, d, first + i, j, share * lane(entry, i));
          }
        }
      }
    }
  }
}

template <class T, class Single>
void ExpansionTest<T, Single>::find_sample(const Model& model, const ShiftPlaces& places,
                                           ShiftExpansion::Sample& sample) {
  LevelSolver<Single> solver(model, places.all);
  const std::size_t diagonals = model.mechanism().diagonals.size();
  std::vector<Single> flat(diagonals, Single(0));
  for (int first = 0; first < sample.block.sheets; first += kLanes<Single>) {
    const int count = std::min(kLanes<Single>, sample.block.sheets - first);
    solver.load(sample.block, first, count);
    flat_lengths(model.mechanism(), solver.geometry(), flat.data());
    for (const int place : {ShiftPlaces::kEarly, ShiftPlaces::kLate}) {
      solver.solve(place);
      for (int i = 0; i < count; ++i) {
        char& is_known = sample.is_known[first + i];
        is_known =
            (place == ShiftPlaces::kEarly || is_known) && solver.length_error(place, i).has_value();
        double* const to =
            (place == ShiftPlaces::kEarly ? sample.elongations : sample.slopes).data() +
            (first + i) * diagonals;
        for (std::size_t d = 0; d < diagonals; ++d) {
          to[d] = place == ShiftPlaces::kEarly
                      ? static_cast<double>(lane(solver.lengths()[d], i)) - lane(flat[d], i)
                      : static_cast<double>(lane(solver.slopes()[d], i));
        }
      }
    }
  }
}

template <class T, class Single>
template <class Rules>
void ExpansionTest<T, Single>::run(const ShiftBlock& block, Rules& rules) {
  if (!expansion_) return;
  for (int first = 0; first < block.sheets; first += kSheetsAtOnce) {
    const int count = std::min(kSheetsAtOnce, block.sheets - first);
    look_at(block, first, count);
    const std::vector<int> all = asked_;
    const std::size_t diagonals = directions_.size() / static_cast<std::size_t>(count);
    for (int group = 0; group < expansion_->groups(); ++group) {
      add_up(group);
      const Short* sums = sums_.data();
      std::erase_if(asked_, [&](int sheet) {
        signed char* const directions =
            directions_.data() + static_cast<std::size_t>(sheet) * diagonals;
        const bool both =
            expansion_->see(group, sums, directions + group * ShiftExpansion::kDiagonals);
        sums += kSums;
        if (both) rules.expect(first + sheet, directions, true, late_sample_);
        return both;
      });
    }
    for (const int sheet : asked_) {
      rules.expect(first + sheet, directions_.data() + static_cast<std::size_t>(sheet) * diagonals,
                   false, late_sample_);
    }
  }
}

// Tests sheets first ... first + count - 1, where their shifts are ternary.
template <class T, class Single>
void ExpansionTest<T, Single>::look_at(const ShiftBlock& block, int first, int count) {
  const int vertices = expansion_->vertices();
  const std::size_t stride = static_cast<std::size_t>(2 * vertices + ProductTable::kPadding);
  asked_.clear();
  rows_.resize(static_cast<std::size_t>(count * vertices));
  signs_.resize(static_cast<std::size_t>(count) * stride);
  directions_.assign(static_cast<std::size_t>(count * expansion_->diagonals()), 0);
  const double amplitude_mm = amplitude_mm_;
  std::uint16_t* row = rows_.data();
  for (int s = 0; s < count; ++s) {
    const double* const shift = block.of(first + s);
    signed char* const sign = signs_.data() + static_cast<std::size_t>(s) * stride;
    int others = 0;
    for (int j = 0; j < 2 * vertices; ++j) {
      sign[j] = static_cast<signed char>((shift[j] > 0) - (shift[j] < 0));
      others |= sign[j] * amplitude_mm != shift[j];
    }
    for (int v = 0; v < vertices; ++v) {
      const int place = ShiftExpansion::place_of(sign[2 * v], sign[2 * v + 1]);
      *row++ = static_cast<std::uint16_t>(place * kRow);
    }
    if (others == 0) asked_.push_back(s);
  }
}

// Adds up a group's entries for the sheets that are tested.
template <class T, class Single>
void ExpansionTest<T, Single>::add_up(int group) {
  sums_.resize(asked_.size() * kSums);
  Short* sums = sums_.data();
  for (const int sheet : asked_) {
    const std::uint16_t* const rows = rows_.data() + sheet * expansion_->vertices();
    const Short* of_vertex = expansion_->single(group, 0, 0);
    Shorts sum[kPieces] = {};
    for (int vertex = 0; vertex < expansion_->vertices(); ++vertex) {
      const Shorts* const row = reinterpret_cast<const Shorts*>(of_vertex + rows[vertex]);
#pragma GCC unroll 8
      for (int k = 0; k < kPieces; ++k) sum[k] += row[k];
      of_vertex += ShiftExpansion::kPlaces * kRow;
    }
    std::memcpy(sums, sum, sizeof sum);
    sums += kSums;
  }
  products_.find(expansion_->products(), group, signs_.data(), asked_, sums_.data() + kRow, kSums);
}

}  // namespace misalign::solver
