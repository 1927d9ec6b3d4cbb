#include "search/ranks/messages.hpp"

#include <cassert>
#include <cstring>
#include <type_traits>

#include "schema/catalogue/metric_table.hpp"

namespace misalign::search {
namespace {

// The same list of fields, written or read: `Wire` is Writer or Reader.
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

void shifts_fields(Writer& wire, const Eigen::Matrix2Xd& shifts) {
  wire.field(shifts.cols());
  for (Eigen::Index k = 0; k < shifts.size(); ++k) wire.field(shifts.data()[k]);
}

void shifts_fields(Reader& wire, Eigen::Matrix2Xd& shifts) {
  Eigen::Index columns = 0;
  wire.field(columns);
  shifts.resize(2, columns);
  for (Eigen::Index k = 0; k < shifts.size(); ++k) wire.field(shifts.data()[k]);
}

template <class Wire, class Unit>
void unit_fields(Wire& wire, Unit& unit) {
  wire.field(unit.range);
  wire.field(unit.worker);
  wire.field(unit.accepted);
  wire.field(unit.rejected);
  wire.field(unit.seconds);
  list(wire, unit.candidates, [&](auto& candidate) {
    wire.field(candidate.draw);
    metrics_fields(wire, candidate.metrics);
    shifts_fields(wire, candidate.shifts_mm);
  });
  list(wire, unit.undecided, [&](auto& draw) { wire.field(draw); });
  list(wire, unit.fault_sample, [&](auto& draw) { wire.field(draw); });
}

using Seen = std::pair<std::pair<int, int>, std::uint64_t>;

}  // namespace

std::string message_layout() {
  std::string layout = std::to_string(sizeof(schema::DrawVerdict));
  const solver::Metrics metrics{};
  schema::each_metric(metrics, [&](const schema::MetricEntry& entry, const auto& value) {
    layout += " " + std::string(entry.name) + ":" + std::to_string(sizeof value);
  });
  return layout;
}

Bytes pack(const SentUnit& sent) {
  Writer wire;
  const schema::UnitRecord& unit = sent.unit;
  wire.field(sent.was_stopped);
  unit_fields(wire, unit);
  const std::vector<Seen> screened(unit.screened.begin(), unit.screened.end());
  list(wire, screened, [&](const Seen& seen) {
    wire.field(seen.first.first);
    wire.field(seen.first.second);
    wire.field(seen.second);
  });
  return wire.take();
}

Bytes pack(const schema::DrawRange& range) {
  Writer wire;
  wire.field(range);
  return wire.take();
}

schema::DrawRange unpack_range(const Bytes& bytes) {
  Reader wire(bytes);
  schema::DrawRange range{};
  wire.field(range);
  return range;
}

SentUnit unpack_unit(const Bytes& bytes) {
  Reader wire(bytes);
  SentUnit sent;
  schema::UnitRecord& unit = sent.unit;
  wire.field(sent.was_stopped);
  unit_fields(wire, unit);
  std::vector<Seen> screened;
  list(wire, screened, [&](Seen& seen) {
    wire.field(seen.first.first);
    wire.field(seen.first.second);
    wire.field(seen.second);
  });
  unit.screened.insert(screened.begin(), screened.end());
  return sent;
}

int message_length(std::size_t bytes, std::size_t most) {
  if (bytes <= most) return static_cast<int>(bytes);
  throw schema::UserError(schema::kExitFailure,
                          "the results of one unit take " + std::to_string(bytes) +
                              " bytes (one message may have " + std::to_string(most) +
                              "); give smaller units with --unit-draws");
}

}  // namespace misalign::search
