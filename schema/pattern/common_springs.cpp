// Makes the table of common springs.
//
// A helical spring of n coils of wire of diameter d, with the mean diameter D, has the rate
// G d^4 / (8 D^3 n), G = 81.5 GPa of music wire (EN 10270-1). A force F twists the wire by the
// stress K 8 F D / (pi d^3), with Wahl's factor K and the index C = D / d; at most 0.45 of the
// tensile strength 2211 d^-0.145 MPa is permitted (Shigley, Mechanical Engineering Design, table
// 10-4 and 10-7). Springs that pull are wound close, with an initial stress of
// 231 exp(-0.105 C) MPa (the same, section 10-11) and full loops, whose insides are the ends of its
// free length. Springs that push have closed and ground ends and a gap of D/4 between coils.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "schema/pattern/spring_table.hpp"

namespace misalign::schema {
namespace {

constexpr double kShear_mpa = 81500;
constexpr double kPermitted = 0.45;  // stress by strength
// Part of the travel to the solid length that is kept free.
constexpr double kFreeTravel = 0.15;

struct Size {
  double wire_mm, outer_mm;

  double mean_mm() const { return outer_mm - wire_mm; }
  double index() const { return mean_mm() / wire_mm; }
  double rate_n_per_mm(double coils) const {
    return kShear_mpa * std::pow(wire_mm, 4) / (8 * std::pow(mean_mm(), 3) * coils);
  }
  double largest_force_n() const {
    const double c = index();
    const double wahl = (4 * c - 1) / (4 * c - 4) + 0.615 / c;
    const double stress_mpa = kPermitted * 2211 * std::pow(wire_mm, -0.145);
    return stress_mpa * std::numbers::pi * std::pow(wire_mm, 3) / (8 * wahl * mean_mm());
  }
  double initial_force_n() const {
    const double stress_mpa = 231 * std::exp(-0.105 * index());
    return stress_mpa * std::numbers::pi * std::pow(wire_mm, 3) / (8 * mean_mm());
  }
};

constexpr Size kPulling[] = {{0.25, 3}, {0.3, 3}, {0.4, 4}, {0.5, 5}, {0.6, 6}, {0.8, 8}, {1, 10}};
constexpr double kPullingFree_mm[] = {20, 30, 40, 60};
constexpr Size kPushing[] = {{0.3, 4}, {0.5, 5}, {0.8, 8}};
constexpr double kPushingFree_mm[] = {20, 30, 50};

double rounded(double value, double unit) { return std::round(value / unit) * unit; }
// Numbers of catalogues have three digits.
double three_digits(double value) {
  return rounded(value, std::pow(10, std::floor(std::log10(value)) - 2));
}

double invented_price(const Size& size, double free_mm) {
  return rounded(0.3 + 0.01 * size.wire_mm * free_mm, 0.01);
}

SpringRow pulling(const Size& size, double free_mm) {
  const double loops_mm = 2 * (size.outer_mm - 2 * size.wire_mm);
  const double coils = std::floor((free_mm - loops_mm) / size.wire_mm - 1);
  const double rate = three_digits(size.rate_n_per_mm(coils));
  const double initial_n = three_digits(size.initial_force_n());
  const double travel_mm = (size.largest_force_n() - initial_n) / rate;
  return {fmt::format("pulls {:g} x {:g} x {:g}", size.wire_mm, size.outer_mm, free_mm),
          {.action = solver::SpringAction::pulls,
           .rate_n_per_mm = rate,
           .free_mm = free_mm,
           .limit_mm = std::floor(free_mm + travel_mm),
           .wire_mm = size.wire_mm,
           .outer_mm = size.outer_mm,
           .price = invented_price(size, free_mm),
           .initial_n = initial_n}};
}

SpringRow pushing(const Size& size, double free_mm) {
  const double pitch_mm = size.wire_mm + size.mean_mm() / 4;
  const double coils = std::floor((free_mm - 2 * size.wire_mm) / pitch_mm);
  const double rate = three_digits(size.rate_n_per_mm(coils));
  const double solid_mm = (coils + 2) * size.wire_mm;
  const double travel_mm =
      std::min((1 - kFreeTravel) * (free_mm - solid_mm), size.largest_force_n() / rate);
  return {fmt::format("pushes {:g} x {:g} x {:g}", size.wire_mm, size.outer_mm, free_mm),
          {.action = solver::SpringAction::pushes,
           .rate_n_per_mm = rate,
           .free_mm = free_mm,
           .limit_mm = std::ceil(free_mm - travel_mm),
           .wire_mm = size.wire_mm,
           .outer_mm = size.outer_mm,
           .price = invented_price(size, free_mm)}};
}

}  // namespace

std::vector<SpringRow> common_springs() {
  std::vector<SpringRow> table;
  for (const Size& size : kPulling) {
    for (const double free_mm : kPullingFree_mm) table.push_back(pulling(size, free_mm));
  }
  for (const Size& size : kPushing) {
    for (const double free_mm : kPushingFree_mm) table.push_back(pushing(size, free_mm));
  }
  return table;
}

}  // namespace misalign::schema
