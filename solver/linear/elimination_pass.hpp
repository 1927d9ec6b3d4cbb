// Eliminates numerically in the fixed order: without search, branch on a value or allocation. Every
// operation is written out, and none is fused or reordered: a slot is updated in the order of the
// pivots, so a lane has the bits of the scalar code.
//
// A single pivot is subtracted from each row below in turn. For a block of pivots, tiles of a few
// rows and columns stay in registers while all its pivots are subtracted: a target is loaded and
// stored once, a multiplier serves a tile's columns and an entry its rows.
#pragma once

#include "solver/kinematics/lane_math.hpp"
#include "solver/linear/elimination.hpp"

namespace misalign::solver {

template <class T>
class EliminationPass {
 public:
  /// Works on `slots`; `packed` has plan.most_packed places. A right-hand side `y` in elimination
  /// order becomes L^-1 y, as a further column would; nullptr if there is none.
  EliminationPass(const Elimination& plan, T* slots, T* inverse_pivots, T* packed, T* y)
      : plan_(plan), slots_(slots), inverse_pivots_(inverse_pivots), packed_(packed), y_(y) {}

  void run() {
    for (const Elimination::Block& block : plan_.blocks) {
      for (std::int32_t k = block.fill.begin; k < block.fill.end; ++k) {
        slots_[plan_.fill_slots[k]] = T(0);
      }
      if (block.size() == 1) {
        eliminate_pivot(block);
      } else {
        eliminate_block(block);
      }
    }
  }

 private:
  static constexpr int kTileRows = kLanes<T> >= 8 ? 4 : 2;  // AVX-512 has twice the registers
  static constexpr int kTileColumns = 4;

  void eliminate_pivot(const Elimination::Block& block) {
    const T inverse_pivot = T(1) / slots_[plan_.pivots[block.first].slot];
    inverse_pivots_[block.first] = inverse_pivot;
    const T* const row = slots_ + block.upper.begin;
    const int length = block.upper.size();
    const std::int32_t* target = plan_.targets.data() + block.first_target;
    for (std::int32_t k = block.lower.begin; k < block.lower.end; ++k, target += length) {
      T& lower = slots_[plan_.lower_slot[k]];
      const T factor = lower * inverse_pivot;
      lower = factor;
      for (int u = 0; u < length; ++u) slots_[target[u]] = slots_[target[u]] - factor * row[u];
      if (y_) y_[plan_.lower_row[k]] = y_[plan_.lower_row[k]] - factor * y_[block.first];
    }
  }

  void eliminate_block(const Elimination::Block& block) {
    const int columns = block.size() + block.upper.size();
    for (std::int32_t k = block.first; k < block.end; ++k) {
      T* const pivot = slots_ + plan_.pivots[k].slot;
      subtract_pivots(block.first, k, columns, pivot - (k - block.first), k);
      inverse_pivots_[k] = T(1) / *pivot;
    }
    pack(block);
    const std::int32_t* target = plan_.targets.data() + block.first_target;
    std::int32_t k = block.lower.begin;
    for (; k + kTileRows <= block.lower.end; k += kTileRows) {
      eliminate_rows<kTileRows>(block, k, target);
      target += kTileRows * block.upper.size();
    }
    for (; k < block.lower.end; ++k, target += block.upper.size()) {
      eliminate_rows<1>(block, k, target);
    }
  }

  // Subtracts the pivots from `first` up to `end` from `columns` entries of `row`, which begins in
  // the first pivot's column and is row number `number`.
  void subtract_pivots(std::int32_t first, std::int32_t end, int columns, T* row, int number) {
    for (std::int32_t k = first; k < end; ++k, ++row, --columns) {
      const T factor = *row * inverse_pivots_[k];
      *row = factor;
      const T* const pivot = slots_ + plan_.pivots[k].slot;
      for (int u = 1; u < columns; ++u) row[u] = row[u] - factor * pivot[u];
      if (y_) y_[number] = y_[number] - factor * y_[k];
    }
  }

  // Packs the block's rows beyond its own columns, one tile width after another.
  void pack(const Elimination::Block& block) {
    T* packed = packed_;
    const int length = block.upper.size();
    for (int u = 0; u < length;) {
      const int width = u + kTileColumns <= length ? kTileColumns : 1;
      for (std::int32_t k = block.first; k < block.end; ++k) {
        const T* const row = slots_ + plan_.pivots[k].upper.end - length + u;
        for (int c = 0; c < width; ++c) *packed++ = row[c];
      }
      u += width;
    }
  }

  template <int Rows>
  void eliminate_rows(const Elimination::Block& block, std::int32_t lower,
                      const std::int32_t* target) {
    const int size = block.size(), length = block.upper.size();
    T* factors[Rows];
    for (int r = 0; r < Rows; ++r) {
      factors[r] = slots_ + plan_.lower_slot[lower + r] - (size - 1);
      subtract_pivots(block.first, block.end, size, factors[r], plan_.lower_row[lower + r]);
    }
    const T* packed = packed_;
    for (int u = 0; u < length;) {
      if (u + kTileColumns <= length) {
        subtract_tile<Rows, kTileColumns>(size, factors, packed, target + u, length);
        packed += kTileColumns * size;
        u += kTileColumns;
      } else {
        subtract_tile<Rows, 1>(size, factors, packed, target + u, length);
        packed += size;
        ++u;
      }
    }
  }

  template <int Rows, int Columns>
  void subtract_tile(int size, T* const* factors, const T* packed, const std::int32_t* target,
                     int stride) {
    T tile[Rows][Columns];
    for (int r = 0; r < Rows; ++r) {
      for (int c = 0; c < Columns; ++c) tile[r][c] = slots_[target[r * stride + c]];
    }
    for (int k = 0; k < size; ++k, packed += Columns) {
      for (int r = 0; r < Rows; ++r) {
        const T factor = factors[r][k];
        for (int c = 0; c < Columns; ++c) tile[r][c] = tile[r][c] - factor * packed[c];
      }
    }
    for (int r = 0; r < Rows; ++r) {
      for (int c = 0; c < Columns; ++c) slots_[target[r * stride + c]] = tile[r][c];
    }
  }

  const Elimination& plan_;
  T* const slots_;
  T* const inverse_pivots_;
  T* const packed_;
  T* const y_;
};

}  // namespace misalign::solver
