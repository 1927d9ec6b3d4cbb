// 113-bit arithmetic, as IEEE binary128, behind calls: solver::evaluate has every operation
// inlined, and with these a compiler would take over 20 GB.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace misalign::bench {

class Quad {
 public:
  Quad(double value = 0) : value_(value) {}
  explicit operator double() const;

  friend Quad operator+(const Quad& a, const Quad& b);
  friend Quad operator-(const Quad& a, const Quad& b);
  friend Quad operator*(const Quad& a, const Quad& b);
  friend Quad operator/(const Quad& a, const Quad& b);
  Quad operator-() const;
  friend bool operator<(const Quad& a, const Quad& b);
  friend bool operator<=(const Quad& a, const Quad& b);
  friend Quad sqrt(const Quad& a);
  friend Quad abs(const Quad& a);

 private:
  using Value = boost::multiprecision::cpp_bin_float_quad;
  explicit Quad(const Value& value) : value_(value) {}

  Value value_;
};

}  // namespace misalign::bench
