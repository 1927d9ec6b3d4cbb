// The first question that a draw is asked, before anything is solved: what its shifts make of the
// diagonals to second order (a ShiftExpansion). It is made ready here as well: from gradients by
// the adjoint of the loop closure on sheets with one coordinate shifted, with bounds from drawn
// sheets.
#pragma once

#include <memory>

#include "solver/lanes/angle_solver.hpp"
#include "solver/lanes/observers.hpp"
#include "solver/model/flat_gradient.hpp"
#include "solver/model/shift_expansion.hpp"

namespace misalign::solver {

/// T is a register of doubles, Single one of floats.
template <class T, class Single>
class ExpansionTest {
 public:
  /// Without an expansion where shifts are not ternary, tables would be too large, or too few
  /// sheets could be turned away.
  explicit ExpansionTest(const Model& model);

  bool is_there() const { return expansion_ != nullptr; }
  /// The tables; only where they are there.
  const ShiftExpansion& expansion() const { return *expansion_; }

  /// Tells `rules` (a RejectionTest) what is certain of each sheet of the block.
  template <class Rules>
  void run(const ShiftBlock& block, Rules& rules);

 private:
  using Short = ShiftExpansion::Short;
  // As many as a register of T holds, but for AVX-512, which adds shorts in halves.
  static constexpr int kBytes = std::min<int>(sizeof(T), 32);
  using Shorts [[gnu::vector_size(kBytes), gnu::aligned(2), gnu::may_alias]] = Short;
  static constexpr int kRow = ShiftExpansion::kRow;
  static constexpr int kPieces = kRow * static_cast<int>(sizeof(Short)) / kBytes;

  void make_ready(const Model& model, int early_sample);
  void find_gradients(const Model& model, const ShiftAngles& angles, ShiftGradients& gradients);
  void find_sample(const Model& model, const ShiftAngles& angles, ShiftSample& sample);
  void add_up(const ShiftBlock& block, int first, int count);
  void add_up(int group, int vertex, int count);

  static int sign_of(double shift) { return (shift > 0) - (shift < 0); }

  std::unique_ptr<ShiftExpansion> expansion_;
  double amplitude_mm_;
  int late_sample_ = 0;
  std::vector<std::uint16_t> rows_;  // sheet by sheet, of some: of each vertex, by its place
  std::vector<char> is_ternary_;     // of the same sheets: others are not for the tables
  std::vector<Short> sums_;          // of the same sheets
  std::vector<signed char> directions_;
};

// Whose shares are measured; and so many that a vertex's part of the tables is worth loading.
constexpr int kSampleSheets = 1024, kSheetsAtOnce = 1024;
// Beyond, tables come from the third-level cache and cost what they save.
constexpr std::size_t kMostTableBytes = 8 << 20;
// Tables that turn away less than this share of the sheets are not worth their time.
constexpr double kLeastTurnedAway = 0.1;
// Of the sample, what must be known of the shares that are left out.
constexpr double kLeastKnown = 0.9;

template <class T, class Single>
ExpansionTest<T, Single>::ExpansionTest(const Model& model) : amplitude_mm_(model.ternary_mm()) {
  const std::size_t vertices = model.shifted().size();
  // With springs beside the vertices unshifted sheets elongate too: expansions have no such term.
  if (model.ternary_mm() <= 0 || vertices == 0 || model.tests().empty() ||
      !model.mechanism().springs.at_vertices() ||
      model.sample_deg() > kRejection.longest_sample_for_slopes_deg ||
      ShiftExpansion::bytes(static_cast<int>(vertices), model.mechanism().diagonal_count()) >
          kMostTableBytes) {
    return;
  }
  const int far = model.tests()[0].sample, early = early_sample(far);
  late_sample_ = late_sample(far);
  if (early < 1 || late_sample_ <= early) return;
  make_ready(model, early);
}

template <class T, class Single>
void ExpansionTest<T, Single>::make_ready(const Model& model, int early_sample) {
  const ShiftAngles angles(model, early_sample, late_sample_);
  ShiftGradients gradients(model);
  find_gradients(model, angles, gradients);
  expansion_ = std::make_unique<ShiftExpansion>(gradients);
  ShiftSample sample(model, kSampleSheets);
  find_sample(model, angles, sample);
  add_up(sample.block, 0, kSampleSheets);
  expansion_->calibrate(sums_, sample);
  directions_.resize(model.mechanism().diagonals.size());
  int turned_away = 0, known = 0;
  for (int s = 0; s < kSampleSheets; ++s) {
    turned_away += expansion_->see(sums_.data() + s * expansion_->sums(), directions_.data());
    known += sample.is_known[s];
  }
  if (turned_away < kLeastTurnedAway * kSampleSheets || known < kLeastKnown * kSampleSheets) {
    expansion_.reset();
  }
}

// Of lengths early and on both sides of the late angle: elongations are lengths less flat ones.
template <class T, class Single>
void ExpansionTest<T, Single>::find_gradients(const Model& model, const ShiftAngles& angles,
                                              ShiftGradients& gradients) {
  const Mechanism& mechanism = model.mechanism();
  const double amplitude = model.ternary_mm() / mechanism.panel_width_mm;
  const double per_step = amplitude / (2 * ShiftAngles::kHalfStep_deg * kRadPerDeg);
  const struct {
    int angle;
    ShiftedQuantity quantity;
    double share;
  } looks[] = {{ShiftAngles::kEarly, ShiftedQuantity::elongation, amplitude},
               {ShiftAngles::kBefore, ShiftedQuantity::slope, -per_step},
               {ShiftAngles::kAfter, ShiftedQuantity::slope, per_step}};
  AngleSolver<T> solver(model, angles.all);
  FlatGradient<T> gradient(mechanism);
  std::vector<T> row(static_cast<std::size_t>(2 * mechanism.vertices), T(0));
  for (int first = 0; first < gradients.sheets().sheets; first += kLanes<T>) {
    const int count = std::min(kLanes<T>, gradients.sheets().sheets - first);
    solver.load(gradients.sheets(), first, count);
    for (const auto& [angle, quantity, share] : looks) {
      solver.solve(angle);
      gradient.at(solver.geometry(), solver.state());
      for (int d = 0; d < mechanism.diagonal_count(); ++d) {
        gradient.with_pilot_held(d, solver.factors(), row);
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
void ExpansionTest<T, Single>::find_sample(const Model& model, const ShiftAngles& angles,
                                           ShiftSample& sample) {
  AngleSolver<Single> solver(model, angles.all);
  const std::size_t diagonals = model.mechanism().diagonals.size();
  std::vector<Single> flat(diagonals, Single(0));
  for (int first = 0; first < sample.block.sheets; first += kLanes<Single>) {
    const int count = std::min(kLanes<Single>, sample.block.sheets - first);
    solver.load(sample.block, first, count);
    flat_lengths(model.mechanism(), solver.geometry(), flat.data());
    for (const int angle : {ShiftAngles::kEarly, ShiftAngles::kLate}) {
      solver.solve(angle);
      for (int i = 0; i < count; ++i) {
        char& is_known = sample.is_known[first + i];
        is_known =
            (angle == ShiftAngles::kEarly || is_known) && solver.length_error(angle, i).has_value();
        double* const to =
            (angle == ShiftAngles::kEarly ? sample.elongations : sample.slopes).data() +
            (first + i) * diagonals;
        for (std::size_t d = 0; d < diagonals; ++d) {
          to[d] = angle == ShiftAngles::kEarly
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
    add_up(block, first, count);
    for (int s = 0; s < count; ++s) {
      if (!is_ternary_[s]) continue;
      const bool both = expansion_->see(sums_.data() + s * expansion_->sums(), directions_.data());
      rules.expect(first + s, directions_.data(), both, late_sample_);
    }
  }
}

// Sums of sheets first ... first + count - 1.
template <class T, class Single>
void ExpansionTest<T, Single>::add_up(const ShiftBlock& block, int first, int count) {
  const int vertices = expansion_->vertices();
  rows_.resize(static_cast<std::size_t>(count * vertices));
  std::uint16_t* row = rows_.data();
  is_ternary_.resize(static_cast<std::size_t>(count));
  for (int s = 0; s < count; ++s) {
    const double* shift = block.of(first + s);
    bool is_ternary = true;
    for (int v = 0; v < vertices; ++v, shift += 2) {
      const int x = sign_of(shift[0]), y = sign_of(shift[1]);
      is_ternary &= (x * amplitude_mm_ == shift[0]) & (y * amplitude_mm_ == shift[1]);
      *row++ = static_cast<std::uint16_t>(ShiftExpansion::place_of(x, y) * kRow);
    }
    is_ternary_[s] = is_ternary;
  }
  sums_.assign(static_cast<std::size_t>(count) * expansion_->sums(), 0);
  for (int group = 0; group < expansion_->groups(); ++group) {
    for (int vertex = 0; vertex < vertices; ++vertex) add_up(group, vertex, count);
  }
}

// What one vertex adds, of all these sheets: its part of the tables stays in the cache.
template <class T, class Single>
void ExpansionTest<T, Single>::add_up(int group, int vertex, int count) {
  const int vertices = expansion_->vertices();
  const std::uint16_t* rows = rows_.data() + vertex;
  Short* sums = sums_.data() + group * 2 * kRow;
  for (int s = 0; s < count; ++s, rows += vertices, sums += expansion_->sums()) {
    const Shorts* const alone =
        reinterpret_cast<const Shorts*>(expansion_->single(group, vertex, *rows / kRow));
    Shorts* const first = reinterpret_cast<Shorts*>(sums);
    Shorts* const second = first + kPieces;
    Shorts sum[kPieces];
    for (int k = 0; k < kPieces; ++k) {
      first[k] += alone[k];
      sum[k] = second[k] + alone[kPieces + k];
    }
    const Short* of_next = expansion_->pair(group, vertex, *rows / kRow);
#pragma GCC unroll 8
    for (int next = 1; next < vertices - vertex; ++next) {
      const Shorts* const row = reinterpret_cast<const Shorts*>(of_next + rows[next]);
#pragma GCC unroll 8
      for (int k = 0; k < kPieces; ++k) sum[k] += row[k];
      of_next += ShiftExpansion::kPlaces * kRow;
    }
    for (int k = 0; k < kPieces; ++k) second[k] = sum[k];
  }
}

}  // namespace misalign::solver
