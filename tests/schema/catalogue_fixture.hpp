// A catalogue in a temporary directory, and 128-bit arithmetic to check its digest with.
#pragma once

#include <gtest/gtest.h>
#include <xxhash.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <random>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/digest.hpp"
#include "schema/catalogue/result_table.hpp"
#include "schema/files/carried_files.hpp"
#include "schema/records/fault_sample.hpp"
#include "tests/folder.hpp"

namespace misalign::schema {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"  // 128 bits, to check arithmetic made of two halves
using Wide = unsigned __int128;
#pragma GCC diagnostic pop

inline std::string little_endian(Wide value, int bytes) {
  std::string text;
  for (int k = 0; k < bytes; ++k) text.push_back(static_cast<char>(value >> (8 * k) & 0xff));
  return text;
}

inline Wide xxh3(const std::string& bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return static_cast<Wide>(hash.high64) << 64 | hash.low64;
}

inline std::string hex_of(Wide value) {
  std::string text;
  for (int shift = 124; shift >= 0; shift -= 4) {
    text.push_back("0123456789abcdef"[static_cast<int>(value >> shift & 15)]);
  }
  return text;
}

/// The contract's digest, from bytes written here.
inline std::string expected_digest(const std::string& identity,
                                   const std::vector<DrawRange>& merged,
                                   const std::vector<std::pair<std::uint64_t, int>>& accepted,
                                   std::uint64_t undecided) {
  std::string bytes = identity;
  for (const DrawRange& range : merged) {
    bytes += little_endian(range.lo, 8) + little_endian(range.hi, 8);
  }
  Wide sum = 0;
  for (const auto& [draw, sample] : accepted) {
    sum += xxh3(little_endian(draw, 8) + little_endian(static_cast<unsigned>(sample), 4));
  }
  bytes += little_endian(accepted.size(), 8) + little_endian(undecided, 8) + little_endian(sum, 16);
  return hex_of(xxh3(bytes));
}

inline Wide as_wide(const CandidateSum& sum) {
  Wide value = 0;
  const auto bytes = sum.bytes();
  for (int k = 15; k >= 0; --k) value = value << 8 | bytes[k];
  return value;
}

inline CandidateSum as_sum(Wide value) {
  const std::string bytes = little_endian(value, 16);
  return CandidateSum::from_bytes(reinterpret_cast<const unsigned char*>(bytes.data()));
}

inline const RunInfo kRun{"host", "0", "none", "g++", "-O2", "golden", 2};

/// Does this to a catalogue's rows past keys, checks and triggers, which are there again
/// afterwards.
inline void change_rows(const std::string& path, const std::string& sql) {
  SQLite::Database database(path, SQLite::OPEN_READWRITE);
  std::string without, again;
  SQLite::Statement triggers(database,
                             "SELECT name, sql FROM sqlite_schema WHERE type = 'trigger'");
  while (triggers.executeStep()) {
    without += "DROP TRIGGER " + triggers.getColumn(0).getString() + ";";
    again += triggers.getColumn(1).getString() + ";";
  }
  database.exec("PRAGMA foreign_keys = OFF; PRAGMA ignore_check_constraints = ON; " + without +
                sql + ";" + again);
}

class CatalogueTest : public testing::Test {
 protected:
  std::string path(const std::string& name = "a.db") const { return folder_.file(name); }

  /// An invented science of draws, so that what a catalogue must say is known without one.
  static bool is_accepted(std::uint64_t draw) { return draw % 97 == 5; }
  static bool is_undecided(std::uint64_t draw) { return draw % 1009 == 3; }
  static int sample_of(std::uint64_t draw) { return 170 + static_cast<int>(draw % 11); }

  Candidate candidate(std::uint64_t draw) const {
    Candidate c{draw, {}, Eigen::Matrix2Xd::Zero(2, campaign_.pattern.base.sheet.vertex_count())};
    c.metrics.deploys_from_sample = sample_of(draw);
    c.metrics.deploys_from_deg = sample_of(draw);
    c.metrics.slope_between_min_mm_per_deg = 0.001;
    c.metrics.elongation.assign(mechanism_.diagonals.size(), 0.25);
    c.shifts_mm(0, 9) = 0.4;
    return c;
  }

  UnitRecord unit(std::uint64_t lo, std::uint64_t hi,
                  const std::function<bool(std::uint64_t)>& accepted = is_accepted) const {
    UnitRecord record;
    record.range = {lo, hi};
    record.seconds = 0.5;
    for (std::uint64_t draw = lo; draw < hi; ++draw) {
      if (accepted(draw)) {
        record.candidates.push_back(candidate(draw));
      } else if (is_undecided(draw)) {
        record.undecided.push_back(
            {draw, {7, solver::Fault::undecided, -1, solver::PathEnd::stalled}});
      } else {
        ++record.rejected;
        ++record.screened[{static_cast<int>(solver::Fault::not_monotone), 8}];
      }
      if (FaultSampleRule().holds(draw)) {
        const int sample = accepted(draw) ? sample_of(draw) : 7;
        record.fault_sample.push_back({draw, {sample, solver::Fault::not_monotone, 0}});
      }
    }
    record.accepted = record.candidates.size();
    return record;
  }

  CatalogueState state(const std::string& name = "a.db") const {
    return read_state(*open_for_reading(path(name)));
  }

  std::int64_t count(const std::string& from, const std::string& name = "a.db") const {
    return open_for_reading(path(name))->execAndGet("SELECT count(*) FROM " + from).getInt64();
  }

  /// What the digest must be for these ranges.
  std::string expected(const std::vector<DrawRange>& merged) const {
    std::vector<std::pair<std::uint64_t, int>> accepted;
    std::uint64_t undecided = 0;
    for (const DrawRange& range : merged) {
      for (std::uint64_t draw = range.lo; draw < range.hi; ++draw) {
        if (is_accepted(draw)) accepted.emplace_back(draw, sample_of(draw));
        undecided += !is_accepted(draw) && is_undecided(draw);
      }
    }
    return expected_digest(identity(campaign_), merged, accepted, undecided);
  }

  Catalogue open(const std::string& name = "a.db") const {
    return {path(name), campaign_, mechanism_};
  }

  static solver::Mechanism mechanism_of(const Campaign& campaign) {
    const auto& base = campaign.pattern.base;
    return solver::build_mechanism(base);
  }

  static Campaign changed(const char* patch) {
    Json json = campaign_json(default_campaign());
    json.merge_patch(Json::parse(patch));
    return read_campaign(json, "test");
  }

  /// The UserError of a call: its cause (none if there was none) and its sentence.
  struct Refusal {
    std::optional<Cause> cause;
    std::string sentence;
  };
  static Refusal refusal(const std::function<void()>& call) {
    try {
      call();
      return {};
    } catch (const UserError& error) {
      return {error.cause(), error.what()};
    }
  }

  const Campaign campaign_ = default_campaign();
  const solver::Mechanism mechanism_ = mechanism_of(campaign_);
  const Folder folder_{"catalogue"};
};

}  // namespace misalign::schema
