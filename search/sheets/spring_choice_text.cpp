#include <fmt/format.h>

#include "schema/exchange/actuators_json.hpp"
#include "search/sheets/study_texts.hpp"
#include "search/terminal/count_text.hpp"

namespace misalign::search {

std::string spring_choice_text(const solver::Sheet& sheet, const solver::SpringChoice& choice) {
  const solver::Mechanism& mechanism = sheet.mechanism();
  const double to_deg = choice.options.to_deg;
  if (!choice.drives()) {
    return fmt::format("no springs within these limits drive it from {:g} to {:g} deg; {}\n",
                       choice.from_deg, to_deg,
                       *choice.driven_from_deg > 0
                           ? fmt::format("they do from {:.4g} deg", *choice.driven_from_deg)
                           : "nor do they from any smaller angle");
  }
  std::string text = fmt::format(
      "friction overcome from {:g} to {:g} deg: {:.4g} N mm/mm, the least at {:.4g} deg\n",
      choice.from_deg, to_deg, choice.static_n_mm_per_mm, choice.weakest_deg);
  if (choice.static_margin) {
    text += fmt::format("static margin: {:.3g}\n", *choice.static_margin);
  }
  text += fmt::format("bound of all choices: {:.4g} N mm/mm; of the linear program: {:.4g}\n",
                      choice.bound_n_mm_per_mm, choice.relaxed_n_mm_per_mm);
  text += fmt::format("{} of {} diagonals carry a spring{}; {}\n", choice.springs.size(),
                      mechanism.diagonal_count(),
                      !choice.proven_fewest   ? ""
                      : *choice.proven_fewest ? " (proven minimum)"
                                              : " (perhaps not the minimum)",
                      count_text(static_cast<std::uint64_t>(choice.programs), "linear program"));
  text += "\n diagonal  rate N/mm     free_mm   longer than flat\n";
  for (const solver::ChosenSpring& spring : choice.springs) {
    const double flat_mm = sheet.way()->flat_mm()(spring.diagonal);
    text += fmt::format("{:>9} {:>10.4g} {:>11.3f} {:>10.3f} %\n",
                        schema::diagonal_label(mechanism, spring.diagonal), spring.rate_n_per_mm,
                        spring.free_mm, 100 * (spring.free_mm / flat_mm - 1));
  }
  return text;
}

}  // namespace misalign::search
