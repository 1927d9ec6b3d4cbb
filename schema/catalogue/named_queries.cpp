#include "schema/catalogue/named_queries.hpp"

#include <fmt/format.h>

#include <cassert>

#include "schema/files/carried_files.hpp"

namespace misalign::schema {
namespace {

const std::string kQueryFolder = "schema/queries/";

}  // namespace

std::string named_query(const std::string& name) {
  for (const CarriedFile& file : carried_files()) {
    if (file.path == kQueryFolder + name + ".sql") return file.text;
  }
  return "";
}

std::string named_query_list() { return fmt::to_string(fmt::join(named_queries(), ", ")); }

std::vector<std::string> named_queries() {
  std::vector<std::string> names;
  for (const CarriedFile& file : carried_files()) {
    if (file.path.rfind(kQueryFolder, 0) != 0) continue;
    const std::string name = file.path.substr(kQueryFolder.size());
    names.push_back(name.substr(0, name.size() - 4));
  }
  return names;
}

LimitedQuery limited(const std::string& named) {
  const std::size_t limit = named.rfind("LIMIT ");
  if (limit == std::string::npos) return {named, 0};
  return {named.substr(0, limit), std::stoull(named.substr(limit + 6))};
}

std::string best_order() {
  const LimitedQuery best = limited(named_query("best"));
  const std::size_t begin = best.all.find("ORDER BY ");
  assert(begin != std::string::npos && best.most > 0);
  return best.all.substr(begin);
}

}  // namespace misalign::schema
