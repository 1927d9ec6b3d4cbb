#include "search/ranks/messages.hpp"

#include "search/ranks/wire.hpp"

namespace misalign::search {
namespace {

template <class Wire, class Unit>
void unit_fields(Wire& wire, Unit& unit) {
  wire.field(unit.range);
  wire.field(unit.worker);
  wire.field(unit.accepted);
  wire.field(unit.rejected);
  wire.field(unit.seconds);
  wire.field(unit.tables_deg);
  list(wire, unit.candidates, [&](auto& candidate) {
    candidate_fields(wire, candidate);
    optional_field(wire, candidate.certificate, [&](auto& row) { certificate_fields(wire, row); });
  });
  list(wire, unit.undecided, [&](auto& draw) { wire.field(draw); });
  list(wire, unit.fault_sample, [&](auto& draw) { wire.field(draw); });
}

// Writes or reads a unit, with its map as the list `screened`.
template <class Wire, class Sent, class Screened>
void sent_unit_fields(Wire& wire, Sent& sent, Screened& screened) {
  wire.field(sent.was_stopped);
  unit_fields(wire, sent.unit);
  list(wire, screened, [&](auto& seen) {
    wire.field(seen.first.first);
    wire.field(seen.first.second);
    wire.field(seen.second);
  });
}

constexpr auto range_fields = [](auto& wire, auto& range) { wire.field(range); };

using Screened = std::vector<std::pair<std::pair<int, int>, std::uint64_t>>;

}  // namespace

std::string candidate_layout() {
  std::string layout = std::to_string(sizeof(schema::DrawVerdict));
  const solver::Metrics metrics{};
  schema::each_metric(metrics, [&](const schema::MetricEntry& entry, const auto& value) {
    layout += " " + std::string(entry.name) + ":" + std::to_string(sizeof value);
  });
  return layout + " ascent";
}

std::string message_layout() { return candidate_layout() + " certificate tables"; }

Bytes pack(const SentUnit& sent) {
  Writer wire;
  const Screened screened(sent.unit.screened.begin(), sent.unit.screened.end());
  sent_unit_fields(wire, sent, screened);
  return wire.take();
}

Bytes pack(const schema::DrawRange& range) { return packed(range, range_fields); }

schema::DrawRange unpack_range(const Bytes& bytes) {
  return unpacked<schema::DrawRange>(bytes, range_fields);
}

SentUnit unpack_unit(const Bytes& bytes) {
  Reader wire(bytes);
  SentUnit sent;
  Screened screened;
  sent_unit_fields(wire, sent, screened);
  sent.unit.screened.insert(screened.begin(), screened.end());
  return sent;
}

int message_length(std::size_t bytes, std::size_t most) {
  if (bytes <= most) return static_cast<int>(bytes);
  throw schema::UserError(schema::Cause::failure,
                          "the results of one unit have " + std::to_string(bytes) +
                              " bytes (a message has at most " + std::to_string(most) +
                              "); make units smaller with " + schema::parameter("unit_draws"));
}

}  // namespace misalign::search
