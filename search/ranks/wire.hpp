// Converts fields of messages to bytes and back, by one list of fields.
#pragma once

#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "schema/catalogue/metric_table.hpp"
#include "schema/records/unit_record.hpp"

namespace misalign::search {

using Bytes = std::vector<char>;

/// Writes fields. `Wire`, below, is a Writer or a Reader.
class Writer {
 public:
  template <class T>
  void field(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const char* bytes = reinterpret_cast<const char*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof value);
  }
  void text(const std::string& text) {
    field(text.size());
    bytes_.insert(bytes_.end(), text.begin(), text.end());
  }
  Bytes take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

/// Reads fields. Bytes that end too early leave fields unchanged, and lists empty.
class Reader {
 public:
  explicit Reader(const Bytes& bytes) : bytes_(bytes) {}
  template <class T>
  void field(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (!has(1, sizeof value)) return;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
  }
  void text(std::string& text) {
    std::size_t size = 0;
    field(size);
    if (!has(size, 1)) size = 0;
    text.assign(bytes_.data() + at_, size);
    at_ += size;
  }
  /// Returns whether the bytes left hold `items` of at least `bytes_each`.
  bool has(std::size_t items, std::size_t bytes_each) {
    if (items > (bytes_.size() - at_) / bytes_each) is_whole_ = false;
    return is_whole_;
  }
  /// Returns whether every byte was read, and none was missing.
  bool is_whole() const { return is_whole_ && at_ == bytes_.size(); }

 private:
  const Bytes& bytes_;
  std::size_t at_ = 0;
  bool is_whole_ = true;
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
  items.clear();
  if constexpr (std::is_arithmetic_v<T>) {
    items.resize(wire.has(size, sizeof(T)) ? size : 0);
    for (T& item : items) each(item);
  } else {  // one by one, so that memory is taken only for existing items
    while (items.size() < size && wire.has(1, 1)) each(items.emplace_back());
    if (!wire.has(0, 1)) items.clear();
  }
}

template <class T, class Each>
void optional_field(Writer& wire, const std::optional<T>& value, Each&& each) {
  wire.field(value.has_value());
  if (value) each(*value);
}

template <class T, class Each>
void optional_field(Reader& wire, std::optional<T>& value, Each&& each) {
  bool is_there = false;
  wire.field(is_there);
  value.reset();
  if (is_there) each(value.emplace());
}

/// Converts a value to bytes, and bytes to a value, by `fields`(wire, value).
template <class Value, class Fields>
Bytes packed(const Value& value, const Fields& fields) {
  Writer wire;
  fields(wire, value);
  return wire.take();
}
template <class Value, class Fields>
Value unpacked(const Bytes& bytes, const Fields& fields) {
  Reader wire(bytes);
  Value value{};
  fields(wire, value);
  return value;
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
  const bool is_there =
      columns >= 0 && wire.has(static_cast<std::size_t>(columns), 2 * sizeof(double));
  shifts.resize(2, is_there ? columns : 0);
  for (Eigen::Index k = 0; k < shifts.size(); ++k) wire.field(shifts.data()[k]);
}

/// Writes or reads a whole schema::CertificateRecord.
template <class Wire, class Row>
void certificate_fields(Wire& wire, Row& row) {
  wire.field(row.draw);
  wire.field(row.certified_deg);
  wire.field(row.asked_deg);
  wire.text(row.end);
  wire.text(row.place);
  wire.field(row.contact);
  wire.field(row.intervals);
  wire.field(row.seconds);
  wire.text(row.proof);
  wire.text(row.hash);
}

/// Writes or reads a whole schema::AscentRecord.
template <class Wire, class Ascent>
void ascent_fields(Wire& wire, Ascent& ascent) {
  for (auto* value : {&ascent.start_value, &ascent.end_value}) {
    optional_field(wire, *value, [&](auto& number) { wire.field(number); });
  }
  wire.field(ascent.steps);
  wire.field(ascent.sheets_folded);
  wire.text(ascent.ended);
  optional_field(wire, ascent.limited_by, [&](auto& text) { wire.text(text); });
}

/// Writes or reads a candidate without its certificate, which it lacks in a splitting search.
template <class Wire, class Candidate>
void candidate_fields(Wire& wire, Candidate& candidate) {
  wire.field(candidate.draw);
  metrics_fields(wire, candidate.metrics);
  shifts_fields(wire, candidate.shifts_mm);
  optional_field(wire, candidate.ascent, [&](auto& ascent) { ascent_fields(wire, ascent); });
}

}  // namespace misalign::search
