#include "schema/pattern/fill_words.hpp"

#include <fmt/format.h>

#include "schema/files/user_error.hpp"
#include "schema/pattern/preload_json.hpp"

namespace misalign::schema {
namespace {

using solver::Fill;

[[noreturn]] void refuse_filling(const Fill& fill, const std::string& why) {
  throw UserError(
      solver::OptionFault{"fill", fill_words(fill), why,
                          "give springs by " + parameter("fill", R"({"kind":"springs"})")});
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

std::string fill_words(const Fill& fill) {
  const char* const parts = fill_nouns(fill).parts;
  if (const auto* const springs = std::get_if<solver::Springs>(&fill)) {
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

std::string rest_words(const Fill& fill) {
  const double at_deg = solver::rest_deg(fill);
  const std::string when = at_deg == 0 ? "when flat" : fmt::format("at {:g} deg", at_deg);
  if (const auto* const springs = std::get_if<solver::Springs>(&fill)) {
    if (springs->preload.is_any()) {
      return "preloaded with " + preload_words(springs->preload) + " " + when;
    }
  } else if (const auto* const plates = std::get_if<solver::RubberPlates>(&fill)) {
    if (plates->prestretch != 1) {
      return fmt::format("pre-stretched by {:g} {}", plates->prestretch, when);
    }
  }
  return "relaxed " + when;
}

const char* state_words(const Fill& fill) {
  const auto* const springs = std::get_if<solver::Springs>(&fill);
  const auto* const plates = std::get_if<solver::RubberPlates>(&fill);
  if (springs && springs->preload.is_any()) return "preloaded";
  return plates && (plates->prestretch != 1 || !plates->cut_outs.empty()) ? "pre-stretched"
                                                                          : "relaxed";
}

std::string filling_words(const Fill& fill) {
  if (std::holds_alternative<solver::NoFill>(fill)) return fill_words(fill);
  return fill_words(fill) + ", " + rest_words(fill);
}

bool are_equal_springs(const Fill& fill) {
  const auto* const springs = std::get_if<solver::Springs>(&fill);
  return springs && springs->rest_deg == 0 && !springs->pull_only && springs->single.empty() &&
         springs->on == solver::SpringsOn::all;
}

void need_springs(const Fill& fill, const std::string& who) {
  if (std::holds_alternative<solver::Springs>(fill)) return;
  refuse_filling(fill, "is no filling for " + who + " (they know springs alone)");
}

void need_plain_springs(const Fill& fill, const std::string& who) {
  need_springs(fill, who);
  const auto& springs = std::get<solver::Springs>(fill);
  if (springs.pull_only) refuse_filling(fill, "pull only, but springs of " + who + " push, too");
  if (springs.on != solver::SpringsOn::all || !springs.single.empty()) {
    refuse_filling(fill, "differ, but springs of " + who + " are all equal");
  }
}

}  // namespace misalign::schema
