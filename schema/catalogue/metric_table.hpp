// One table of the metrics: what each is called, what it means, and how it is stored, compared and
// shown. Whatever knows metrics by name reads it; to add one, see the head of metric_table.cpp.
#pragma once

#include <limits>
#include <span>
#include <string_view>
#include <variant>

#include "solver/records/metrics.hpp"

namespace misalign::schema {

/// By how much a value may differ from machine to machine, or from solver to solver: absolute +
/// relative * |value|. The origin of each stands beside it in the table.
struct Allowance {
  /// What `absolute` is multiplied by: nothing, the panel width in mm, or that over the degrees
  /// from sample to sample.
  enum class Of { one, width_mm, width_mm_per_sample };
  double absolute = 0, relative = 0;
  Of of = Of::one;

  bool allows(double a, double b, double width_mm, double sample_deg) const;
};

/// What values there may be.
struct ValueRange {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool above_least = false;  ///< the least value itself is none
};

struct MetricAge {
  int first = 1;    ///< the metrics version (kMetricsVersion) that it came with
  int present = 1;  ///< the one since which it means what it does
};

struct MetricEntry {
  using Member = std::variant<int solver::Metrics::*, double solver::Metrics::*,
                              std::optional<double> solver::Metrics::*>;

  const char* name;  ///< of the column and of the JSON key
  Member member;
  const char* unit;     ///< "share" of a flat length: 0.02 is 2 %; "count"; "" for pure numbers
  const char* meaning;  ///< sentences for people
  ValueRange range = {};
  Allowance allowance = {};  ///< of numbers that are not whole
  MetricAge age = {};
  int schema_since = 1;         ///< the schema version since which there is its column
  const char* label = nullptr;  ///< heads a column of the report; without one it is not shown there
  /// With how many digits, a way that schema/report/metrics.js knows; counts and shares have
  /// theirs.
  const char* written = "digits_3";
  bool less_is_better = false;
  bool none_is_best = false;      ///< no value is better than any
  bool negative_is_bad = false;   ///< and is shown so
  bool needs_a_campaign = false;  ///< it looks up to the threshold of one

  bool is_whole() const { return std::holds_alternative<int solver::Metrics::*>(member); }
  bool may_be_none() const {
    return std::holds_alternative<std::optional<double> solver::Metrics::*>(member);
  }
};

/// Every metric once, in the order in which people read them.
std::span<const MetricEntry> metric_table();

/// The entry of a column; nothing if it holds no metric.
const MetricEntry* find_metric(std::string_view column);

/// By the name of a column; of the first version where it holds no metric.
MetricAge metric_age(std::string_view column);

/// Calls `see(entry, value)` for every metric of `metrics`, which may be const.
template <class SomeMetrics, class See>
void each_metric(SomeMetrics& metrics, const See& see) {
  for (const MetricEntry& entry : metric_table()) {
    std::visit([&](const auto member) { see(entry, metrics.*member); }, entry.member);
  }
}

}  // namespace misalign::schema
