#include "search/sheets/target_text.hpp"

#include <fmt/format.h>

#include "schema/pattern/fill_words.hpp"

namespace misalign::search {

std::string target_text(const schema::FoldingView& view, const solver::Fill& fill) {
  constexpr double kRounding_n_mm = 1e-9;
  const auto off_mm = schema::off_target_mm(view);
  if (!off_mm) return "";
  std::string text = fmt::format("\ntarget at {:.4f} deg: vertices within {:.2g} mm",
                                 view.base.folded_target->pilot_deg, *off_mm);
  const auto held = schema::held_at_target(view, fill);
  if (!held) return text;
  if (!(held->barrier_n_mm > kRounding_n_mm)) {
    return text + "\nno filling holds it there: holes keep their shapes along the path";
  }
  return text + fmt::format(
                    "\n{}: driven to the target from {:.4g} deg{} and from below from "
                    "{:.3g} deg, held up to {:.4g} N mm, at {:.4g} deg",
                    schema::fill_words(fill, view.mechanism.diagonal_count()),
                    held->driven_from_deg, held->is_from_end ? ", the end," : "",
                    held->driven_from_below_deg, held->barrier_n_mm, held->barrier_deg);
}

}  // namespace misalign::search
