// Arithmetic operations that a draw takes: the search's own templates on numbers that count what is
// done with them, one sheet after another. Additions of the tables, of whole numbers, and what
// judges functions outside the lanes are not counted.
//   operations CAMPAIGN.json DRAWS
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "schema/campaign/campaign_file.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/models.hpp"

namespace misalign {
namespace {

template <class Number>
struct Counted {
  using value_type = Number;
  static inline long operations = 0;  // additions, subtractions, products
  static inline long slow = 0;        // quotients and roots

  Counted() = default;
  Counted(Number from) : value(from) {}  // NOLINT: as registers do
  Counted(int from) : value(static_cast<Number>(from)) {}
  template <class Other>
  requires(!std::is_same_v<Other, Number> &&
           std::is_floating_point_v<Other>) explicit Counted(Other from)
      : value(static_cast<Number>(from)) {}

  friend Counted operator+(const Counted& a, const Counted& b) {
    return counted(a.value + b.value);
  }
  friend Counted operator-(const Counted& a, const Counted& b) {
    return counted(a.value - b.value);
  }
  friend Counted operator*(const Counted& a, const Counted& b) {
    return counted(a.value * b.value);
  }
  friend Counted operator/(const Counted& a, const Counted& b) {
    ++slow;
    return Counted(a.value / b.value);
  }
  friend Counted sqrt(const Counted& a) {
    ++slow;
    return Counted(std::sqrt(a.value));
  }
  friend Counted operator-(const Counted& a) { return Counted(-a.value); }
  friend Counted abs(const Counted& a) { return Counted(std::abs(a.value)); }
  friend bool operator<(const Counted& a, const Counted& b) { return a.value < b.value; }
  friend bool operator>(const Counted& a, const Counted& b) { return a.value > b.value; }
  friend bool operator<=(const Counted& a, const Counted& b) { return a.value <= b.value; }
  friend bool operator>=(const Counted& a, const Counted& b) { return a.value >= b.value; }
  friend Counted select(bool condition, const Counted& a, const Counted& b) {
    return condition ? a : b;
  }
  Counted& operator+=(const Counted& b) { return *this = *this + b; }
  Counted& operator-=(const Counted& b) { return *this = *this - b; }
  Counted& operator*=(const Counted& b) { return *this = *this * b; }

  Number value;

 private:
  static Counted counted(Number of) {
    ++operations;
    return Counted(of);
  }
};

}  // namespace
}  // namespace misalign

// The templates look for these before they are used.
#include "solver/lanes/lane_batch.hpp"

namespace misalign {
namespace {

using Double = Counted<double>;
using Single = Counted<float>;

int print(const schema::Campaign& campaign, int draws) {
  const solver::Model model = search::model_of(campaign);
  solver::LaneBatch<Double, Single> batch(model);
  solver::ShiftBlock block;
  block.sheets = draws;
  const std::size_t per_draw = 2 * model.shifted().size();
  block.shifts_mm.resize(per_draw * static_cast<std::size_t>(draws));
  for (int i = 0; i < draws; ++i) {
    search::draw_shifts(campaign.misalignment, campaign.seed, static_cast<std::uint64_t>(i),
                        block.shifts_mm.data() + static_cast<std::size_t>(i) * per_draw);
  }
  batch.reject(block);  // makes the tables ready
  Double::operations = Double::slow = Single::operations = Single::slow = 0;
  const auto& rejections = batch.reject(block);
  solver::ShiftBlock left;
  for (int i = 0; i < draws; ++i) {
    if (rejections[static_cast<std::size_t>(i)].fault != solver::Fault::none) continue;
    left.shifts_mm.insert(left.shifts_mm.end(), block.of(i), block.of(i) + per_draw);
    ++left.sheets;
  }
  const auto row = [&](const char* what, int of) {
    const auto each = [of](long count) { return static_cast<double>(count) / of; };
    fmt::print("{:<34} {:>8.1f} {:>8.1f} {:>8.1f} {:>8.1f}\n", what, each(Single::operations),
               each(Single::slow), each(Double::operations), each(Double::slow));
  };
  fmt::print("{:<34} {:>8} {:>8} {:>8} {:>8}\n", "", "single", "/, root", "double", "/, root");
  row("rejection tests, a draw", draws);
  Double::operations = Double::slow = Single::operations = Single::slow = 0;
  batch.measure(left);
  row("paths and records, a draw", draws);
  if (left.sheets > 0) row("the same, each of those left", left.sheets);
  return 0;
}

}  // namespace
}  // namespace misalign

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "operations CAMPAIGN.json DRAWS\n");
    return 2;
  }
  return misalign::print(misalign::schema::read_campaign_file(argv[1]), std::atoi(argv[2]));
}
