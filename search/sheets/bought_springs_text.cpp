#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "schema/exchange/actuators_json.hpp"
#include "schema/exchange/spring_faces_json.hpp"
#include "schema/files/text_table.hpp"
#include "search/sheets/study_texts.hpp"

namespace misalign::search {
namespace {

std::string friction_lines(const schema::SpringOrder& order) {
  const solver::StockChoice& choice = order.choice;
  std::string text = fmt::format(
      "friction overcome from {:g} to {:g} deg: {:.4g} N mm/mm, the least at {:.4g} deg\n",
      choice.from_deg, choice.options.to_deg, choice.static_n_mm_per_mm, choice.weakest_deg);
  if (order.bent_n_mm_per_mm) {
    text += fmt::format("with panels that bend: {:.4g} N mm/mm\n", *order.bent_n_mm_per_mm);
  }
  if (const auto margin = order.static_margin()) {
    text += fmt::format("static margin: {:.3g}, required {:g}{}\n", *margin, order.wanted_margin,
                        *margin < order.wanted_margin ? " (not reached)" : "");
  }
  return text;
}

std::string groups_table(const solver::Mechanism& mechanism, const schema::SpringOrder& order) {
  std::vector<schema::Row> rows = {
      {"number", "spring", "rate N/mm", "free mm", "link mm", "diagonals"}};
  for (const schema::EqualSprings& group : schema::equal_springs(order)) {
    const schema::SpringRow& row = order.table[static_cast<std::size_t>(group.type)];
    std::vector<std::string> diagonals;
    for (const solver::StockedSpring& spring : group.springs) {
      diagonals.push_back(schema::diagonal_label(mechanism, spring.diagonal));
    }
    rows.push_back({std::to_string(group.springs.size()), row.name,
                    fmt::format("{:.4g}", row.spring.rate_n_per_mm),
                    fmt::format("{:g}", row.spring.free_mm), fmt::format("{:g}", group.link_mm),
                    fmt::format("{}", fmt::join(diagonals, " "))});
  }
  return schema::aligned(rows, {true, false, true, true, true, false});
}

std::string springs_table(const solver::Mechanism& mechanism, const schema::SpringOrder& order) {
  std::vector<schema::Row> rows = {
      {"diagonal", "shortest mm", "longest mm", "limit mm", "force N", "turn", "face", "axis"}};
  for (std::size_t k = 0; k < order.choice.springs.size(); ++k) {
    const solver::StockedSpring& spring = order.choice.springs[k];
    rows.push_back({schema::diagonal_label(mechanism, spring.diagonal),
                    fmt::format("{:.2f}", spring.least_mm - spring.link_mm),
                    fmt::format("{:.2f}", spring.most_mm - spring.link_mm),
                    fmt::format("{:g}", order.row_of(spring).spring.limit_mm),
                    fmt::format("{:.3g}", spring.largest_force_n)});
    const bool has_way = order.way && !order.way->springs.empty();
    if (!has_way) {
      rows.back().insert(rows.back().end(), 3, "-");
      continue;
    }
    const solver::HungSpring& hung = order.way->springs[k];
    rows.back().push_back(std::to_string(hung.turn + 1));
    rows.back().emplace_back(schema::word_of(hung.face));
    rows.back().push_back(schema::height_words(hung));
  }
  return schema::aligned(rows, {false, true, true, true, true, true, false, false});
}

}  // namespace

std::string bought_springs_text(const solver::Sheet& sheet, const schema::SpringOrder& order) {
  const solver::StockChoice& choice = order.choice;
  const solver::Mechanism& mechanism = sheet.mechanism();
  if (!choice.drives()) {
    return fmt::format(
        "no springs of the table drive it from {:g} deg to flat{}; none of them overcome more than "
        "{:.4g} N mm/mm down to {:g} deg, and {:.4g} are required\n",
        choice.from_deg, choice.is_proven ? "" : " that were tried", choice.bound_n_mm_per_mm,
        choice.options.to_deg, choice.options.required_n_mm_per_mm);
  }
  const char* const best = !choice.is_proven        ? ", perhaps not the best"
                           : order.bent_n_mm_per_mm ? ", the best that was found for bending panels"
                                                    : ", proven best";
  std::string text =
      fmt::format("{} of {} diagonals carry a spring; price {:g}{}\n", choice.springs.size(),
                  mechanism.diagonal_count(), choice.price, best);
  text += friction_lines(order) + "\n" + groups_table(mechanism, order) + "\n" +
          springs_table(mechanism, order) + (order.way ? spring_faces_text(*order.way) : "");
  text +=
      "\nThe springs are tense on the flat sheet: a stop, latch or frame has to hold it there "
      "(hold_flat).\n";
  const bool pushes = std::ranges::any_of(choice.springs, [&](const auto& spring) {
    return order.row_of(spring).spring.action == solver::SpringAction::pushes;
  });
  if (pushes) {
    text +=
        "\nSprings that push need a guide, a rod inside or a tube outside, that ends free of "
        "both vertices.\n";
  }
  return text;
}

}  // namespace misalign::search
