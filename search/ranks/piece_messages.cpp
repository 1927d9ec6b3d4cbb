#include "search/ranks/piece_messages.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "search/draws/draw.hpp"
#include "search/ranks/messages.hpp"

namespace misalign::search {
namespace {

template <class Wire, class Numbers>
void numbers(Wire& wire, Numbers& items) {
  list(wire, items, [&](auto& item) { wire.field(item); });
}

template <class Wire, class Scored>
void sheets_fields(Wire& wire, Scored& sheets) {
  wire.field(sheets.sheets.bytes_each);
  numbers(wire, sheets.sheets.bytes);
  numbers(wire, sheets.scores);
}

constexpr auto order_fields = [](auto& wire, auto& order) {
  wire.field(order.population);
  wire.field(order.level);
  wire.field(order.lo);
  wire.field(order.hi);
  wire.field(order.within);
  wire.field(order.next);
  wire.field(order.is_first);
  wire.field(order.is_catalogued);
  sheets_fields(wire, order.here);
  list(wire, order.starts, [&](auto& start) { candidate_fields(wire, start); });
};

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

constexpr auto sent_fields = [](auto& wire, auto& sent) {
  wire.field(sent.was_stopped);
  result_fields(wire, sent.result);
};

bool are_sheets(const ScoredParticles& sheets, const ShiftCode& code) {
  if (sheets.sheets.bytes.size() != sheets.count() * code.bytes()) return false;
  if (sheets.count() > 0 && sheets.sheets.bytes_each != code.bytes()) return false;
  constexpr std::uint8_t kMostLevel = 2;
  return !code.is_ternary() || std::ranges::all_of(sheets.sheets.bytes, [](std::uint8_t level) {
    return level <= kMostLevel;
  });
}

bool are_metrics(const solver::Metrics& metrics, const schema::Campaign& campaign) {
  bool are_finite = true;
  schema::each_metric(metrics, [&](const auto&, const auto& value) {
    if constexpr (requires { value.has_value(); }) {
      are_finite = are_finite && (!value || std::isfinite(*value));
    } else {
      are_finite = are_finite && std::isfinite(static_cast<double>(value));
    }
  });
  return are_finite &&
         std::ranges::all_of(metrics.elongation, [](double e) { return std::isfinite(e); }) &&
         metrics.deploys_from_sample >= campaign.threshold_sample();
}

// Returns whether the catalogue would accept this ascent.
bool is_ascent(const schema::AscentRecord& ascent) {
  const auto is_value = [](const auto& value) { return !value || std::isfinite(*value); };
  return std::ranges::count(schema::kAscentEnds, ascent.ended) == 1 && ascent.steps >= 0 &&
         ascent.sheets_folded >= 0 && is_value(ascent.start_value) && is_value(ascent.end_value) &&
         (!ascent.limited_by || schema::Json::accept(*ascent.limited_by));
}

// Returns whether the candidates are possible and met at different places, which number them.
bool are_met(const PieceResult& result, const schema::Campaign& campaign,
             const solver::Mechanism& mechanism) {
  const std::uint32_t first = result.level == 0 ? 0 : 1;
  const std::uint32_t last = result.level == 0 ? 0 : campaign.search.splitting->sweeps;
  std::set<std::pair<std::uint32_t, std::uint32_t>> places;
  return std::ranges::all_of(result.met, [&](const MetCandidate& met) {
    const schema::Candidate& candidate = met.candidate;
    return met.particle >= result.lo && met.particle < result.hi && met.step >= first &&
           met.step <= last && places.emplace(met.step, met.particle).second &&
           candidate.metrics.elongation.size() == mechanism.diagonals.size() &&
           are_metrics(candidate.metrics, campaign) &&
           (candidate.ascent
                ? is_ascent(*candidate.ascent) && can_be_kept(campaign, candidate.shifts_mm)
                : can_be_drawn(campaign, candidate.shifts_mm));
  });
}

// Returns whether the counts are possible: at least one draw or move of each particle.
bool are_counts(const PieceResult& result, const schema::Campaign& campaign) {
  const std::uint64_t particles = result.hi - result.lo;
  return result.tried >= particles &&
         result.tried <= particles * campaign.search.splitting->sweeps &&
         result.taken <= result.tried && result.undecided <= result.tried - result.taken &&
         result.seconds >= 0 && std::isfinite(result.seconds);
}

bool is_sound(const PieceResult& result, const schema::Campaign& campaign, const ShiftCode& code,
              const solver::Mechanism& mechanism) {
  const auto is_particle = [&](std::uint32_t k) { return k >= result.lo && k < result.hi; };
  return result.lo < result.hi && are_counts(result, campaign) && are_sheets(result.there, code) &&
         std::ranges::all_of(result.there.scores, [](int score) { return score >= 0; }) &&
         result.survivors.size() == result.there.count() &&
         std::ranges::is_sorted(result.survivors, std::less_equal()) &&
         std::ranges::all_of(result.survivors, is_particle) && are_met(result, campaign, mechanism);
}

}  // namespace

std::string piece_layout() { return "piece 3 " + candidate_layout(); }

Bytes pack(const PieceOrder& order) { return packed(order, order_fields); }

PieceOrder unpack_order(const Bytes& bytes) { return unpacked<PieceOrder>(bytes, order_fields); }

Bytes pack(const SentPiece& sent) { return packed(sent, sent_fields); }

SentPiece unpack_piece(const Bytes& bytes) { return unpacked<SentPiece>(bytes, sent_fields); }

std::optional<PieceResult> unpack_kept(const std::string& bytes, const schema::Campaign& campaign,
                                       const ShiftCode& code, const solver::Mechanism& mechanism) {
  const Bytes copy(bytes.begin(), bytes.end());
  Reader wire(copy);
  SentPiece sent;
  sent_fields(wire, sent);
  if (!wire.is_whole() || !is_sound(sent.result, campaign, code, mechanism)) return std::nullopt;
  return std::move(sent.result);
}

}  // namespace misalign::search
