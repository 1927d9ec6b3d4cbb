// Tables the metrics: names, meanings, and how each is stored, compared and shown. All code that
// knows metrics by name reads it; metric_table.cpp says how to add one.
#pragma once

#include <limits>
#include <span>
#include <string_view>
#include <variant>

#include "solver/records/metrics.hpp"

namespace misalign::schema {

/// Largest difference of a value between machines or solvers: absolute + relative * |value|. Its
/// origin is noted in the table.
struct Allowance {
  /// Factor of `absolute`: 1, the panel width in mm, or that width per degree between samples.
  enum class Of { one, width_mm, width_mm_per_sample };
  double absolute = 0, relative = 0;
  Of of = Of::one;

  bool allows(double a, double b, double width_mm, double sample_deg) const;
};

/// Possible values.
struct ValueRange {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool above_least = false;  ///< the least value is excluded
};

struct MetricAge {
  int first = 1;    ///< metrics version (kMetricsVersion) that introduced it
  int present = 1;  ///< metrics version of its present definition
};

struct MetricEntry {
  using Member = std::variant<int solver::Metrics::*, double solver::Metrics::*,
                              std::optional<double> solver::Metrics::*>;

  const char* name;  ///< name of the column and of the JSON key
  Member member;
  const char* unit;     ///< "share" of a flat length: 0.02 is 2 %; "count"; "" for pure numbers
  const char* meaning;  ///< sentences for people
  ValueRange range = {};
  Allowance allowance = {};  ///< tolerance of real numbers
  MetricAge age = {};
  int schema_since = 1;         ///< schema version that introduced its column
  const char* label = nullptr;  ///< heading in the report; null: not shown
  /// Number format, a name in schema/report/metrics.js; counts and shares have their own.
  const char* written = "digits_3";
  bool less_is_better = false;
  bool none_is_best = false;      ///< a missing value is best
  bool negative_is_bad = false;   ///< negative values are marked
  bool needs_a_campaign = false;  ///< it depends on a campaign's threshold
  bool usual = false;  ///< an axis of the report's parallel coordinates unless columns are chosen

  bool is_whole() const { return std::holds_alternative<int solver::Metrics::*>(member); }
  bool may_be_none() const {
    return std::holds_alternative<std::optional<double> solver::Metrics::*>(member);
  }
};

/// Returns every metric once, in the order of display.
std::span<const MetricEntry> metric_table();

/// Returns the entry of a column; null if it holds no metric.
const MetricEntry* find_metric(std::string_view column);

/// Returns the age of a column's metric; version 1 if it holds no metric.
MetricAge metric_age(std::string_view column);

/// Calls `see(entry, value)` for every metric of `metrics`, which may be const.
template <class SomeMetrics, class See>
void each_metric(SomeMetrics& metrics, const See& see) {
  for (const MetricEntry& entry : metric_table()) {
    std::visit([&](const auto member) { see(entry, metrics.*member); }, entry.member);
  }
}

}  // namespace misalign::schema
