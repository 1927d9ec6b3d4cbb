#include "search/designs/number_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <set>

#include "schema/pattern/design_json.hpp"
#include "search/designs/log_spaced.hpp"
#include "search/sheets/least_change.hpp"
#include "search/sheets/preloaded_springs.hpp"

namespace misalign::search {
namespace {

using schema::Design;
using schema::FreeNumber;

// Rates and thicknesses for which the best preload is found, and the number of starts.
constexpr int kRates = 7, kThicknesses = 2;
constexpr std::size_t kStarts = 2;
// The first change of a number that is 0, a share of its largest value.
constexpr double kFromZero = 1.0 / 64;
// The first change of a number, and that below which the search ends.
constexpr double kFirstFactor = 2, kLeastFactor = 1.05;

const FreeNumber* free_number(const schema::Free& free, std::optional<double> Design::*number) {
  const auto at = std::ranges::find_if(
      free.numbers, [&](const FreeNumber& other) { return other.row->number == number; });
  return at == free.numbers.end() ? nullptr : &*at;
}

// Values of a free number from the most to the least: of a range as many.
std::vector<double> spread(const FreeNumber& number, int count) {
  if (!number.is_range) return {number.values.rbegin(), number.values.rend()};
  const double least = std::max(number.least(), kFromZero * number.most());
  std::vector<double> values = log_spaced(number.most(), least, count);
  for (double& value : values) value = number.nearest(two_digits(value));
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

class NumberSearch {
 public:
  NumberSearch(const CardSheet& on, const schema::Free& free, int most_cards)
      : on_(on), free_(free), most_cards_(most_cards) {}

  NumberChoice found(ChoiceStarts from) {
    std::vector<Design> starts;
    if (from == ChoiceStarts::springs) starts = with_best_preloads();
    starts.push_back(nearest());
    for (const Design& start : starts) {
      if (!is_done()) consider(start);
    }
    if (!best_) throw schema::UserError(schema::Cause::bad_input, why_not_);
    for (double factor = kFirstFactor; factor >= kLeastFactor && !is_done();) {
      if (!step(factor)) factor = std::sqrt(factor);
    }
    best_->cards = cards_;
    return *std::move(best_);
  }

 private:
  bool is_done() const {
    return cards_ >= most_cards_ || (best_ && best_->score.value >= kMostReserve);
  }

  // The design's values, as near as they are allowed.
  Design nearest() const {
    Design design = on_.design;
    for (const FreeNumber& number : free_.numbers) {
      std::optional<double>& value = design.*number.row->number;
      const double middle =
          std::sqrt(std::max(number.least(), kFromZero * number.most()) * number.most());
      value = number.nearest(value.value_or(number.row->standard.value_or(two_digits(middle))));
    }
    return design;
  }

  // Designs of springs with their best preload, by linear bending: those that overcome most.
  std::vector<Design> with_best_preloads() const {
    const Design near = nearest();
    const FreeNumber* const rate = free_number(free_, &Design::stiffness_n_per_mm);
    const FreeNumber* const force = free_number(free_, &Design::preload_n);
    const FreeNumber* const thickness = free_number(free_, &Design::thickness_mm);
    if (force == nullptr || !near.is_springs()) return {};
    std::vector<double> thicknesses_mm = {near.plates().thickness_mm};
    if (thickness != nullptr) thicknesses_mm = spread(*thickness, kThicknesses);
    std::vector<double> rates = {near.springs().stiffness_n_per_mm};
    if (rate != nullptr) rates = spread(*rate, kRates);
    std::multimap<double, Design, std::greater<>> by_friction;
    for (const double thickness_mm : thicknesses_mm) {
      Design of_thickness = near;
      if (thickness != nullptr) of_thickness.thickness_mm = thickness_mm;
      const CardSheet thick{on_.chosen, on_.sheet, of_thickness, on_.used_deg};
      for (const PreloadedSprings& springs : preloaded_springs(thick, rates)) {
        if (!(springs.static_n_mm_per_mm > 0)) continue;
        Design start = with_springs(of_thickness, springs);
        start.preload_n = force->nearest(*start.preload_n);
        if (free_.hold_flat && *start.preload_n > 0) start.hold_flat = true;
        by_friction.emplace(springs.static_n_mm_per_mm, std::move(start));
      }
    }
    std::vector<Design> best;
    for (auto& [friction, start] : by_friction) {
      if (best.size() < kStarts) best.push_back(std::move(start));
    }
    return best;
  }

  // Tries the switches, then all changes by a factor; returns whether one was better.
  bool step(double factor) {
    bool is_better = false;
    const auto toggle = [&](bool is_free, void (*change)(Design&)) {
      if (!is_free || is_done()) return;
      Design design = best_->design;
      change(design);
      is_better |= consider(design);
    };
    toggle(free_.hold_flat,
           [](Design& design) { design.hold_flat = !design.hold_flat.value_or(false); });
    toggle(free_.one_a_hole && best_->design.is_springs(), [](Design& design) {
      const bool is_one = design.springs_on == solver::SpringsOn::one_a_hole;
      design.springs_on = is_one ? solver::SpringsOn::all : solver::SpringsOn::one_a_hole;
    });
    for (const FreeNumber& number : free_.numbers) {
      for (const bool is_up : {true, false}) {
        while (!is_done() && consider(changed(number, is_up ? factor : 1 / factor))) {
          is_better = true;
        }
      }
    }
    return is_better;
  }

  // The best design with one number changed; itself at the end of the range.
  Design changed(const FreeNumber& number, double factor) const {
    Design design = best_->design;
    std::optional<double>& value = design.*number.row->number;
    const double now = value.value_or(number.row->standard.value_or(number.least()));
    if (!number.is_range) {
      auto at = std::ranges::find(number.values, now);
      if (at == number.values.end() || (factor < 1 && at == number.values.begin())) return design;
      at += factor > 1 ? 1 : -1;
      if (at != number.values.end()) value = *at;
      return design;
    }
    const double from_zero = kFromZero * number.most();
    double next = now * factor;
    if (now < from_zero) next = factor > 1 ? from_zero : number.least();
    value = number.nearest(two_digits(next, factor > 1 ? Rounding::up : Rounding::down));
    return design;
  }

  // Makes the card of a design that was not tried, and keeps it if it is better.
  bool consider(const Design& design) {
    if (!tried_.insert(schema::explicit_design_json(design).dump()).second) return false;
    ++cards_;
    try {
      NumberChoice choice{design, {}, parts_of(design), 0};
      std::vector<schema::CardLine> lines;
      for (const auto& part : choice.parts) std::ranges::copy(part, std::back_inserter(lines));
      choice.score = score_of(lines);
      if (best_ && choice.score.value <= best_->score.value) return false;
      best_ = std::move(choice);
      return true;
    } catch (const schema::UserError& error) {
      if (why_not_.empty()) why_not_ = error.what();
      return false;
    }
  }

  // The path depends on no number of a design, and contact on springs as bodies.
  CardParts parts_of(const Design& design) {
    const CardSheet on{on_.chosen, on_.sheet, design, on_.used_deg};
    CardParts parts;
    for (std::size_t k = 0; k < kCardParts; ++k) {
      const auto part = static_cast<CardPart>(k);
      if (part == CardPart::copies) continue;
      parts[k] = best_ && is_same(part, design) ? best_->parts[k] : card_lines(part, on, quick_);
    }
    return parts;
  }

  bool is_same(CardPart part, const Design& design) const {
    const Design& other = best_->design;
    if (part == CardPart::path) return true;
    return part == CardPart::contact && design.diameter_mm == other.diameter_mm &&
           design.springs_on == other.springs_on && design.thickness_mm == other.thickness_mm;
  }

  const CardSheet& on_;
  const schema::Free& free_;
  const int most_cards_;
  const CardOptions quick_ = {.advice = Advice::none};
  std::set<std::string> tried_;
  int cards_ = 0;
  std::optional<NumberChoice> best_;
  std::string why_not_;
};

}  // namespace

NumberChoice choose_numbers(const CardSheet& on, const schema::Free& free, int most_cards,
                            ChoiceStarts starts) {
  return NumberSearch(on, free, most_cards).found(starts);
}

std::string chosen_words(const schema::Design& design, const schema::Free& free) {
  std::string words;
  const auto add = [&](const std::string& word) { words += (words.empty() ? "" : ", ") + word; };
  for (const FreeNumber& number : free.numbers) {
    const auto& [block, key] = std::pair(number.row->block, number.row->key);
    const bool is_of_it =
        (block != "springs" || design.is_springs()) && (block != "plate" || design.is_plate());
    const auto& value = design.*number.row->number;
    if (value && is_of_it) {
      add(fmt::format("{}{} {:g}", block == "plate" ? "plate." : "", key, *value));
    }
  }
  if (free.hold_flat && design.hold_flat.value_or(false)) add("hold_flat");
  if (free.one_a_hole && design.springs_on == solver::SpringsOn::one_a_hole) add("one_a_hole");
  return words;
}

}  // namespace misalign::search
