#include "search/designs/design_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "schema/files/text_table.hpp"

namespace misalign::search {
namespace {

std::string result_of(const DesignTry& tried) {
  if (tried.pattern.is_null()) return tried.why;
  if (!tried.passes()) {
    return fmt::format("fails {}: {}", tried.lacks.size(), fmt::join(tried.lacks, "; "));
  }
  if (tried.score.key.empty()) return fmt::format("+{:g} % or more", 100 * kMostReserve);
  return fmt::format("+{:.3g} %, {}", 100 * tried.score.value, short_label(tried.score.what));
}

}  // namespace

std::string designs_text(const std::string& wish, const std::vector<DesignTry>& tries) {
  std::vector<schema::Row> rows = {{"", "sheet", "chosen", "least reserve"}};
  for (const DesignTry& tried : tries) {
    const char* const mark = tried.passes() ? "pass" : tried.pattern.is_null() ? "none" : "FAIL";
    rows.push_back({mark, tried.how, tried.chosen, result_of(tried)});
  }
  const auto passing = std::ranges::count_if(tries, &DesignTry::passes);
  return fmt::format("{}: {} of {} designs meet all requirements\n\n{}", wish, passing,
                     tries.size(), schema::aligned(rows, {false, false, false, false}));
}

}  // namespace misalign::search
