#include "search/ranks/piece_messages.hpp"

#include "search/ranks/messages.hpp"

namespace misalign::search {
namespace {

template <class Wire, class Numbers>
void numbers(Wire& wire, Numbers& items) {
  list(wire, items, [&](auto& item) { wire.field(item); });
}

template <class Wire, class Sheets>
void sheets_fields(Wire& wire, Sheets& sheets) {
  wire.field(sheets.sheets.bytes_each);
  numbers(wire, sheets.sheets.bytes);
  numbers(wire, sheets.scores);
}

template <class Wire, class Order>
void order_fields(Wire& wire, Order& order) {
  wire.field(order.population);
  wire.field(order.level);
  wire.field(order.lo);
  wire.field(order.hi);
  wire.field(order.within);
  wire.field(order.next);
  wire.field(order.is_first);
  wire.field(order.is_catalogued);
  sheets_fields(wire, order.here);
}

template <class Wire, class Result>
void result_fields(Wire& wire, Result& result) {
  wire.field(result.population);
  wire.field(result.level);
  wire.field(result.lo);
  wire.field(result.hi);
  wire.field(result.tried);
  wire.field(result.taken);
  wire.field(result.undecided);
  wire.field(result.seconds);
  numbers(wire, result.survivors);
  sheets_fields(wire, result.there);
  list(wire, result.met, [&](auto& met) {
    wire.field(met.step);
    wire.field(met.particle);
    candidate_fields(wire, met.candidate);
  });
}

}  // namespace

std::string piece_layout() { return "piece 1 " + message_layout(); }

Bytes pack(const PieceOrder& order) {
  Writer wire;
  order_fields(wire, order);
  return wire.take();
}

PieceOrder unpack_order(const Bytes& bytes) {
  Reader wire(bytes);
  PieceOrder order{};
  order_fields(wire, order);
  return order;
}

Bytes pack(const SentPiece& sent) {
  Writer wire;
  wire.field(sent.was_stopped);
  result_fields(wire, sent.result);
  return wire.take();
}

SentPiece unpack_piece(const Bytes& bytes) {
  Reader wire(bytes);
  SentPiece sent;
  wire.field(sent.was_stopped);
  result_fields(wire, sent.result);
  return sent;
}

}  // namespace misalign::search
