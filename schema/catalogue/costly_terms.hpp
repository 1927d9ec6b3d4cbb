// Makes SQLite evaluate costly functions last: on rows for which everything else holds.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace misalign::schema {

/// Functions of our own that follow a path, some milliseconds each (search/checks).
inline constexpr std::array<std::string_view, 2> kCostlyFunctions = {
    "deploy_time_s", "critical_friction_n_mm_per_mm"};

/// The same query, each call of theirs in a WHERE or ON a scalar subquery: SQLite computes terms
/// that have one last, whatever the order in which AND joins them.
std::string costly_in_subqueries(const std::string& query);

/// The same condition, likewise, and its terms with a costly function behind all others, which may
/// be subqueries themselves.
std::string costly_last(const std::string& condition);

}  // namespace misalign::schema
