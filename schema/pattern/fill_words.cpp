#include "schema/pattern/fill_words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/files/user_error.hpp"
#include "schema/pattern/preload_json.hpp"

namespace misalign::schema {
namespace {

using solver::Fill;

constexpr int kUnknown = 0;  // number of diagonals

[[noreturn]] void refuse_filling(const Fill& fill, const std::string& why) {
  throw UserError(
      solver::OptionFault{"fill", fill_words(fill, kUnknown), why,
                          "give springs by " + parameter("fill", R"({"kind":"springs"})")});
}

// The load of a filling at its rest.
enum class Rest { relaxed, preloaded, of_own_lengths, prestretched, of_own_cut_outs };

Rest rest_of(const Fill& fill) {
  if (const auto* const springs = std::get_if<solver::Springs>(&fill)) {
    if (springs->preload.is_any()) return Rest::preloaded;
    const auto is_own = [](const solver::SingleSpring& spring) {
      return spring.free_mm.has_value();
    };
    return std::ranges::any_of(springs->single, is_own) ? Rest::of_own_lengths : Rest::relaxed;
  }
  if (const auto* const plates = std::get_if<solver::RubberPlates>(&fill)) {
    if (plates->prestretch != 1) return Rest::prestretched;
    return plates->cut_outs.empty() ? Rest::relaxed : Rest::of_own_cut_outs;
  }
  return Rest::relaxed;
}

}  // namespace

FillNouns fill_nouns(const Fill& fill) {
  if (const auto* const springs = std::get_if<solver::Springs>(&fill)) {
    return springs->pull_only ? FillNouns{"wires", "wire", "  wires"}
                              : FillNouns{"springs", "spring", "springs"};
  }
  if (std::holds_alternative<solver::RubberPlates>(fill)) {
    return {"rubber plates", "rubber plate", " plates"};
  }
  return {"empty holes", "empty hole", "filling"};
}

std::string fill_words(const Fill& fill, int diagonals) {
  const char* const parts = fill_nouns(fill).parts;
  if (const auto* const springs = std::get_if<solver::Springs>(&fill)) {
    if (!springs->single.empty() && std::ssize(springs->single) == diagonals) {
      return std::string(parts) + ", each with its rate and free length";
    }
    return fmt::format("{} of {:g} N/mm{}{}", parts, springs->stiffness_n_per_mm,
                       springs->on == solver::SpringsOn::one_a_hole ? ", one a hole" : "",
                       springs->single.empty() ? "" : ", some of other rates or free lengths");
  }
  if (const auto* const plates = std::get_if<solver::RubberPlates>(&fill)) {
    return fmt::format("{} of {:g} mm, shear modulus {:g} MPa{}", parts, plates->thickness_mm,
                       plates->shear_mpa,
                       plates->cut_outs.empty() ? "" : ", some with a cut-out of their own");
  }
  return parts;
}

std::string rest_words(const Fill& fill, const char* degree) {
  const double at_deg = solver::rest_deg(fill);
  const std::string when = at_deg == 0 ? " when flat" : fmt::format(" at {:g}{}", at_deg, degree);
  std::string how;
  switch (rest_of(fill)) {
    case Rest::relaxed:
      break;
    case Rest::preloaded:
      how = " with " + preload_words(std::get<solver::Springs>(fill).preload);
      break;
    case Rest::of_own_lengths:
      how = " by free lengths of their own";
      break;
    case Rest::prestretched:
      how = fmt::format(" by {:g}", std::get<solver::RubberPlates>(fill).prestretch);
      break;
    case Rest::of_own_cut_outs:
      how = " by cut-outs of their own";
      break;
  }
  return state_words(fill) + how + when;
}

const char* state_words(const Fill& fill) {
  switch (rest_of(fill)) {
    case Rest::relaxed:
      return "relaxed";
    case Rest::preloaded:
    case Rest::of_own_lengths:
      return "preloaded";
    case Rest::prestretched:
    case Rest::of_own_cut_outs:
      return "pre-stretched";
  }
  return "";
}

std::string filling_words(const Fill& fill, int diagonals, const char* degree) {
  if (std::holds_alternative<solver::NoFill>(fill)) return fill_words(fill, diagonals);
  return fill_words(fill, diagonals) + ", " + rest_words(fill, degree);
}

bool are_equal_springs(const Fill& fill) {
  return solver::are_plain_springs(fill) && solver::is_relaxed_flat(fill);
}

void need_springs(const Fill& fill, const std::string& who) {
  if (std::holds_alternative<solver::Springs>(fill)) return;
  refuse_filling(fill, "is no filling for " + who + " (they know springs alone)");
}

void need_like_springs(const Fill& fill, const std::string& who) {
  need_springs(fill, who);
  solver::Springs everywhere = std::get<solver::Springs>(fill);
  everywhere.on = solver::SpringsOn::all;
  need_plain_springs(everywhere, who);
}

void need_plain_springs(const Fill& fill, const std::string& who) {
  need_springs(fill, who);
  const auto& springs = std::get<solver::Springs>(fill);
  if (springs.pull_only) refuse_filling(fill, "pull only, but springs of " + who + " push, too");
  if (!solver::on_all_equally(springs)) {
    refuse_filling(fill, "differ, but springs of " + who + " are all equal");
  }
}

}  // namespace misalign::schema
