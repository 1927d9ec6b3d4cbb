#include "search/ranks/certify_messages.hpp"

namespace misalign::search {
namespace {

template <class Wire, class Order>
void sheet_order_fields(Wire& wire, Order& order) {
  wire.field(order.draw);
  wire.field(order.asked_deg);
  shifts_fields(wire, order.shifts_mm);
  optional_field(wire, order.stored, [&](auto& row) { certificate_fields(wire, row); });
}

template <class Wire, class Result>
void sheet_result_fields(Wire& wire, Result& result) {
  optional_field(wire, result.made, [&](auto& row) { certificate_fields(wire, row); });
  optional_field(wire, result.finding, [&](auto& finding) {
    wire.field(finding.draw);
    optional_field(wire, finding.interval, [&](auto& interval) { wire.field(interval); });
    wire.text(finding.what);
  });
}

constexpr auto sent_fields = [](auto& wire, auto& sent) {
  wire.field(sent.was_stopped);
  wire.field(sent.seconds);
  list(wire, sent.results, [&](auto& result) { sheet_result_fields(wire, result); });
};

constexpr auto orders_fields = [](auto& wire, auto& orders) {
  list(wire, orders, [&](auto& order) { sheet_order_fields(wire, order); });
};

}  // namespace

std::string certify_layout() { return "certify 2"; }

Bytes pack(const std::vector<CertifyOrder>& orders) { return packed(orders, orders_fields); }

std::vector<CertifyOrder> unpack_orders(const Bytes& bytes) {
  return unpacked<std::vector<CertifyOrder>>(bytes, orders_fields);
}

Bytes pack(const SentResults& sent) { return packed(sent, sent_fields); }

SentResults unpack_results(const Bytes& bytes) { return unpacked<SentResults>(bytes, sent_fields); }

}  // namespace misalign::search
