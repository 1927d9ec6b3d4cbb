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

template <class Wire, class Sent>
void sent_fields(Wire& wire, Sent& sent) {
  wire.field(sent.was_stopped);
  wire.field(sent.seconds);
  list(wire, sent.results, [&](auto& result) { sheet_result_fields(wire, result); });
}

}  // namespace

std::string certify_layout() { return "certify 1"; }

Bytes pack(const std::vector<CertifyOrder>& orders) {
  Writer wire;
  list(wire, orders, [&](const CertifyOrder& order) { sheet_order_fields(wire, order); });
  return wire.take();
}

std::vector<CertifyOrder> unpack_orders(const Bytes& bytes) {
  Reader wire(bytes);
  std::vector<CertifyOrder> orders;
  list(wire, orders, [&](CertifyOrder& order) { sheet_order_fields(wire, order); });
  return orders;
}

Bytes pack(const SentResults& sent) {
  Writer wire;
  sent_fields(wire, sent);
  return wire.take();
}

SentResults unpack_results(const Bytes& bytes) {
  Reader wire(bytes);
  SentResults sent;
  sent_fields(wire, sent);
  return sent;
}

}  // namespace misalign::search
