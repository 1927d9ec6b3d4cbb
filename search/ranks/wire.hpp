// Fields of messages as bytes: the same list of them is written or read.
#pragma once

#include <cassert>
#include <cstring>
#include <type_traits>
#include <vector>

#include "schema/catalogue/metric_table.hpp"
#include "schema/catalogue/unit_writer.hpp"

namespace misalign::search {

using Bytes = std::vector<char>;

/// `Wire`, below, is one of these two.
class Writer {
 public:
  template <class T>
  void field(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const char* bytes = reinterpret_cast<const char*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof value);
  }
  Bytes take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

class Reader {
 public:
  explicit Reader(const Bytes& bytes) : bytes_(bytes) {}
  template <class T>
  void field(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    assert(at_ + sizeof value <= bytes_.size());
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
  }

 private:
  const Bytes& bytes_;
  std::size_t at_ = 0;
};

template <class T, class Each>
void list(Writer& wire, const std::vector<T>& items, Each&& each) {
  wire.field(items.size());
  for (const T& item : items) each(item);
}

template <class T, class Each>
void list(Reader& wire, std::vector<T>& items, Each&& each) {
  std::size_t size = 0;
  wire.field(size);
  items.resize(size);
  for (T& item : items) each(item);
}

template <class Wire, class Metrics>
void metrics_fields(Wire& wire, Metrics& metrics) {
  schema::each_metric(metrics, [&](const auto&, auto& value) { wire.field(value); });
  list(wire, metrics.elongation, [&](auto& e) { wire.field(e); });
}

inline void shifts_fields(Writer& wire, const Eigen::Matrix2Xd& shifts) {
  wire.field(shifts.cols());
  for (Eigen::Index k = 0; k < shifts.size(); ++k) wire.field(shifts.data()[k]);
}

inline void shifts_fields(Reader& wire, Eigen::Matrix2Xd& shifts) {
  Eigen::Index columns = 0;
  wire.field(columns);
  shifts.resize(2, columns);
  for (Eigen::Index k = 0; k < shifts.size(); ++k) wire.field(shifts.data()[k]);
}

template <class Wire, class Candidate>
void candidate_fields(Wire& wire, Candidate& candidate) {
  wire.field(candidate.draw);
  metrics_fields(wire, candidate.metrics);
  shifts_fields(wire, candidate.shifts_mm);
}

}  // namespace misalign::search
