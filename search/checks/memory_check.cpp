#include "search/checks/memory_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "schema/files/features.hpp"
#include "search/checks/spread.hpp"
#include "search/sheets/campaign_sheet.hpp"
#include "search/sheets/on_threads.hpp"
#include "search/sheets/sheet_numbers.hpp"
#include "search/terminal/long_work.hpp"
#include "search/terminal/usable_threads.hpp"

namespace misalign::search {
namespace {

using Number = std::optional<double>;

constexpr double kSame = 1e-6;  // largest relative difference, see the header

std::size_t place_of(const std::string& function) {
  const auto& names = sheet_number_names();
  return static_cast<std::size_t>(std::ranges::find(names, function) - names.begin());
}

bool is_computable(const schema::StudyNumber& number) {
  return has("SUNDIALS") || !needs_sundials(place_of(number.function));
}

bool is_same(Number stored, Number again) {
  if (!stored || !again) return stored.has_value() == again.has_value();
  return std::abs(*stored - *again) <= kSame * std::max(std::abs(*stored), std::abs(*again));
}

Number computed_again(FoldingModel& model, const schema::Campaign& campaign,
                      const Eigen::Matrix2Xd& shifts_mm, const schema::StudyNumber& number) {
  const std::size_t place = place_of(number.function);
  WantedNumbers wanted{};
  wanted[place] = true;
  return find_numbers(model.sheet(shifts_mm), model.design(), number.from_deg, wanted, false,
                      campaign.target.get())
      .numbers[place];
}

}  // namespace

MemoryReport check_memory(SQLite::Database& database, const schema::Campaign& campaign,
                          const std::string& path, std::optional<std::uint64_t> sample,
                          std::vector<schema::Finding>& findings) {
  schema::StudyMemory memory(path, campaign);
  std::vector<schema::StudyNumber> all = memory.all();
  MemoryReport report{0, all.size(), memory.stale()};
  if (!memory.fault().empty()) findings.push_back({memory.fault(), {{"where", memory.path()}}});
  std::erase_if(all, [](const auto& number) { return !is_computable(number); });
  const std::vector<schema::StudyNumber> chosen = spread(all, sample);
  std::vector<Eigen::Matrix2Xd> shifts_mm;
  for (const schema::StudyNumber& number : chosen) {
    shifts_mm.push_back(shifts_of_number(database, campaign, number.draw));
  }
  on_threads(
      static_cast<std::size_t>(usable_threads()), chosen.size(),
      [&](std::size_t) {
        return [&, model = std::make_shared<FoldingModel>(campaign)](std::size_t k) {
          return computed_again(*model, campaign, shifts_mm[k], chosen[k]);
        };
      },
      [&](std::size_t k, const Number& again) {
        const schema::StudyNumber& number = chosen[k];
        show_work("remembered numbers computed again", ++report.checked, chosen.size());
        if (schema::sheet_key(shifts_mm[k]) == number.sheet && !is_same(number.value, again)) {
          findings.push_back(schema::differs(
              fmt::format("draw {} ({}; delete it)", number.draw, memory.path()), number.function,
              schema::or_null(number.value), schema::or_null(again)));
        }
        return true;
      });
  return report;
}

}  // namespace misalign::search
