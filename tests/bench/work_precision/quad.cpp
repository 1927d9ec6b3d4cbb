#include "tests/bench/work_precision/quad.hpp"

namespace misalign::bench {

Quad::operator double() const { return static_cast<double>(value_); }

Quad operator+(const Quad& a, const Quad& b) { return Quad(Quad::Value(a.value_ + b.value_)); }
Quad operator-(const Quad& a, const Quad& b) { return Quad(Quad::Value(a.value_ - b.value_)); }
Quad operator*(const Quad& a, const Quad& b) { return Quad(Quad::Value(a.value_ * b.value_)); }
Quad operator/(const Quad& a, const Quad& b) { return Quad(Quad::Value(a.value_ / b.value_)); }
Quad Quad::operator-() const { return Quad(Value(-value_)); }
bool operator<(const Quad& a, const Quad& b) { return a.value_ < b.value_; }
bool operator<=(const Quad& a, const Quad& b) { return a.value_ <= b.value_; }
Quad sqrt(const Quad& a) { return Quad(Quad::Value(sqrt(a.value_))); }
Quad abs(const Quad& a) { return Quad(Quad::Value(abs(a.value_))); }

}  // namespace misalign::bench
