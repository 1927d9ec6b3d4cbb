#include "tests/simulation/look.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>

#include "schema/campaign/campaign_file.hpp"
#include "schema/campaign/draw_ranges.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/certificate_table.hpp"
#include "schema/catalogue/ledger_check.hpp"
#include "search/draws/draw.hpp"
#include "search/terminal/failure.hpp"
#include "search/verbs/border.hpp"
#include "solver/kinematics/mechanism.hpp"
#include "tests/simulation/invented_draws.hpp"

namespace misalign::simulation {
namespace {

using schema::DrawRange;
using schema::Json;

constexpr DrawRange kAll{0, schema::kEndOfDraws};

// Hashes of what a query selects of the candidates, whose numbers may change.
Json sheets_of(SQLite::Database& database, const std::string& select) {
  Json sheets = Json::array();
  SQLite::Statement rows(database, select + " JOIN candidate USING (draw)");
  while (rows.executeStep()) {
    const std::string text = rows.getColumn(0).getString();
    sheets.push_back(XXH3_64bits(text.data(), text.size()));
  }
  return sheets;
}

Json look_at(const std::string& path, const schema::Campaign& campaign, void (*between)()) {
  const auto database = schema::open_for_reading(path);
  const SQLite::Transaction moment(*database);
  const auto units = schema::units_done(*database);
  if (between) between();
  Json look;
  const schema::CheckedLedger checked = schema::read_checked(*database, campaign);
  const auto certificates = schema::check_certificates(*database, campaign);
  for (const auto* findings : {&checked.findings, &certificates.findings}) {
    if (!findings->empty()) look["wrong"] = findings->front().sentence;
  }
  if (!checked.state) {
    look["wrong"] = checked.why_no_state;
    return look;
  }
  look["digest"] = checked.state->digest;
  look["goal_end"] = checked.state->goal_end;
  look["gaps"] = checked.state->gaps.size();
  for (const DrawRange& unit : units) look["done"].push_back({unit.lo, unit.hi});
  look["accepted"] = schema::draws_of(*database, "candidate", kAll);
  look["undecided"] = schema::draws_of(*database, "undecided", kAll);
  look["runs"] = database->execAndGet("SELECT count(*) FROM run").getInt();
  look["certified"] = sheets_of(*database, "SELECT displacements_mm FROM certificate");
  look["yields"] = sheets_of(*database,
                             "SELECT displacements_mm || ' ' || amplitude_mm || ' ' || survivors "
                             "FROM yield");
  return look;
}

// A sum of XXH3-128 hashes modulo 2^128.
struct Sum {
  std::uint64_t low = 0, high = 0;
  void add(const XXH128_hash_t& term) {
    low += term.low64;
    high += term.high64 + (low < term.low64 ? 1 : 0);
  }
};

template <class... Numbers>
std::string bytes_of(const Numbers&... numbers) {
  static_assert(std::endian::native == std::endian::little);
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
  return bytes;
}

std::set<std::uint64_t> within(const std::set<std::uint64_t>& draws, const DrawRange& range) {
  return {draws.lower_bound(range.lo), draws.lower_bound(range.hi)};
}

std::set<std::uint64_t> within(const Json& draws, const DrawRange& range) {
  std::set<std::uint64_t> some;
  for (const std::uint64_t draw : draws) {
    if (draw >= range.lo && draw < range.hi) some.insert(draw);
  }
  return some;
}

}  // namespace

std::function<int(int)> looking_at(const std::string& path, const schema::Campaign& campaign,
                                   void (*between)()) {
  return [path, &campaign, between](int) {
    Json look;
    try {
      look = look_at(path, campaign, between);
    } catch (const std::exception& error) {
      const schema::UserError failure = search::failure_of(error);
      look = {{"sentence", failure.sentence(search::kCommandLine.name_parameter)},
              {"cause", search::exit_code_of(failure.cause())}};
    }
    std::puts(look.dump().c_str());
    return 0;
  };
}

// Contract, "Digest"; a goal of accepted draws ends at a multiple of 4,096.
Expected plain_loop(const schema::Campaign& campaign, std::uint64_t draws) {
  constexpr std::uint64_t kGranule = 4096;
  const auto mechanism = solver::build_mechanism(campaign.pattern.base);
  const int threshold = static_cast<int>(campaign.threshold_deg / campaign.sample_deg + 0.5);
  const auto& wanted = campaign.stop.accepted;
  std::vector<double> shifts_mm(2 * campaign.misalignment.vertices.size());
  Expected expected;
  Sum sum;
  std::uint64_t draw = 0;
  for (; wanted || draw < draws; ++draw) {
    if (wanted && draw % kGranule == 0 && expected.accepted.size() >= *wanted) break;
    search::draw_shifts(campaign.misalignment, campaign.seed, draw, shifts_mm.data());
    const solver::Verdict verdict =
        invented_verdict(shifts_mm, static_cast<int>(mechanism.diagonals.size()));
    if (verdict.first_fault == solver::Fault::undecided) {
      expected.undecided.insert(draw);
    } else if (verdict.deploys_from_sample >= threshold) {
      expected.accepted.insert(draw);
      const std::string term =
          bytes_of(draw, static_cast<std::uint32_t>(verdict.deploys_from_sample));
      sum.add(XXH3_128bits(term.data(), term.size()));
    }
  }
  expected.end = expected.goal_end = draw;
  const std::string text = schema::identity(campaign) +
                           bytes_of(std::uint64_t{0}, draw, std::uint64_t{expected.accepted.size()},
                                    std::uint64_t{expected.undecided.size()}, sum.low, sum.high);
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  expected.digest = fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
  return expected;
}

std::string Kept::take(const Json& look, const Expected& expected, bool is_durable) {
  if (look.contains("wrong")) return look["wrong"];
  std::vector<DrawRange> done;
  for (const Json& unit : look.value("done", Json::array())) done.push_back({unit[0], unit[1]});
  const auto merged = schema::united(done);
  const auto lost = schema::without(seen_.done, merged);
  if (!lost.empty()) return fmt::format("draws {} to {} are lost", lost[0].lo, lost[0].hi);
  std::set<std::uint64_t> certified = look["certified"], yields = look["yields"];
  if (!std::ranges::includes(certified, seen_.certified)) return "a certificate is lost";
  if (!std::ranges::includes(yields, seen_.yields)) return "a yield is lost";
  for (const DrawRange& range : merged) {
    const DrawRange known{range.lo, std::min(range.hi, expected.end)};
    if (known.lo >= known.hi) continue;
    if (within(look["accepted"], known) != within(expected.accepted, known)) {
      return fmt::format("draws {} to {} hold other candidates than a plain loop", known.lo,
                         known.hi);
    }
    if (within(look["undecided"], known) != within(expected.undecided, known)) {
      return fmt::format("draws {} to {} hold other undecided ones", known.lo, known.hi);
    }
  }
  seen_ = {merged, certified, yields};
  if (is_durable) durable_ = seen_;
  return "";
}

void Kept::take_studies(const Kept& other) {
  for (Holdings* mine : {&seen_, &durable_}) {
    mine->certified.insert(other.seen_.certified.begin(), other.seen_.certified.end());
    mine->yields.insert(other.seen_.yields.begin(), other.seen_.yields.end());
  }
}

}  // namespace misalign::simulation
