// Stores sheets as whole numbers, which are particles and travel between ranks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "schema/campaign/campaign.hpp"

namespace misalign::search {

/// The code of a campaign's shifts as whole numbers: a ternary level is 0, 1 or 2 in one byte; a
/// uniform one is its random word in four.
class ShiftCode {
 public:
  explicit ShiftCode(const schema::Misalignment& misalignment);

  /// Number of shifts of a sheet: x and y of each shifted vertex.
  std::size_t shifts() const { return shifts_; }
  std::size_t bytes() const { return shifts_ * width_; }
  bool is_ternary() const { return width_ == 1; }

  using Particle = std::span<std::uint8_t>;
  using ConstParticle = std::span<const std::uint8_t>;
  /// Draws the k-th shift from a random word, as a plain draw does.
  void draw(Particle sheet, std::size_t k, std::uint32_t word) const;
  /// Redraws the k-th shift from a random word: every other value has the same probability (of a
  /// uniform shift: every value).
  void redraw(Particle sheet, std::size_t k, std::uint32_t word) const;
  /// Sets the k-th shift to the source's `from`-th, or to its opposite.
  void copy(Particle sheet, std::size_t k, ConstParticle source, std::size_t from,
            bool negated) const;
  /// Writes all shifts in mm.
  void write_mm(ConstParticle sheet, double* shifts_mm) const;

 private:
  std::uint32_t code(ConstParticle sheet, std::size_t k) const;
  void set(Particle sheet, std::size_t k, std::uint32_t code) const;

  schema::ShiftDistribution distribution_;
  double amplitude_mm_;
  std::size_t shifts_, width_;
};

/// Sheets one after another in contiguous memory.
struct Particles {
  std::size_t bytes_each = 0;
  std::vector<std::uint8_t> bytes;

  static Particles of(std::size_t bytes_each, std::size_t count) {
    return {bytes_each, std::vector<std::uint8_t>(bytes_each * count)};
  }
  std::size_t count() const { return bytes_each > 0 ? bytes.size() / bytes_each : 0; }
  ShiftCode::Particle operator[](std::size_t k) {
    return {bytes.data() + k * bytes_each, bytes_each};
  }
  ShiftCode::ConstParticle operator[](std::size_t k) const {
    return {bytes.data() + k * bytes_each, bytes_each};
  }
  void add(ShiftCode::ConstParticle sheet) {
    bytes_each = sheet.size();
    bytes.insert(bytes.end(), sheet.begin(), sheet.end());
  }
  void add(const Particles& others) {
    if (others.count() > 0) bytes_each = others.bytes_each;
    bytes.insert(bytes.end(), others.bytes.begin(), others.bytes.end());
  }
  void clear() { bytes.clear(); }
};

/// Sheets with their scores.
struct ScoredParticles {
  Particles sheets;
  std::vector<int> scores;

  std::size_t count() const { return scores.size(); }
  /// Reserves memory for exactly `sheets_count` sheets.
  void reserve(std::size_t sheets_count, std::size_t bytes_each) {
    sheets.bytes.reserve(sheets_count * bytes_each);
    scores.reserve(sheets_count);
  }
  void add(const ScoredParticles& others, std::size_t k) {
    sheets.add(others.sheets[k]);
    scores.push_back(others.scores[k]);
  }
  void add(const ScoredParticles& others) {
    sheets.add(others.sheets);
    scores.insert(scores.end(), others.scores.begin(), others.scores.end());
  }
  void clear() {
    sheets.clear();
    scores.clear();
  }
};

}  // namespace misalign::search
