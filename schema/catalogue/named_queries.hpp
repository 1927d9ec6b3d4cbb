// Named queries of the program.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace misalign::schema {

/// Returns the SQL of a named query; empty for an unknown name.
std::string named_query(const std::string& name);
/// "acceptance, best, ..."
std::string named_query_list();
std::vector<std::string> named_queries();

/// A query without the LIMIT at its end, and that limit; 0: none.
struct LimitedQuery {
  std::string all;
  std::uint64_t most = 0;
};
LimitedQuery limited(const std::string& named);

/// Returns the order "best first" of the query `best`: "ORDER BY ..., ..." on columns of the view
/// candidates.
std::string best_order();

}  // namespace misalign::schema
