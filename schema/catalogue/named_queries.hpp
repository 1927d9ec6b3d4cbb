// The queries that the program carries, by their names.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace misalign::schema {

/// The SQL of a named query; empty if there is no such name.
std::string named_query(const std::string& name);
/// "acceptance, best, ..."
std::string named_query_list();
std::vector<std::string> named_queries();

/// A query without the LIMIT that a named one may end with, and that; 0: none.
struct LimitedQuery {
  std::string all;
  std::uint64_t most = 0;
};
LimitedQuery limited(const std::string& named);

/// The order "the best first" as the query `best` states it: "ORDER BY ..., ..." on the columns of
/// the view candidates.
std::string best_order();

}  // namespace misalign::schema
