#include "search/sheets/card_remedies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string_view>

#include "search/sheets/better_sheet.hpp"
#include "search/sheets/card_changes.hpp"
#include "search/sheets/card_drive.hpp"
#include "search/sheets/card_variant.hpp"
#include "search/sheets/least_change.hpp"
#include "search/sheets/preloaded_springs.hpp"
#include "search/sheets/studies.hpp"
#include "search/terminal/shell_word.hpp"
#include "solver/contact/spring_clearance.hpp"

namespace misalign::search {
namespace {

using schema::CardLine;
using schema::Design;
using schema::line_of;
using schema::Remedy;
using Way = NumberChange::Way;

constexpr std::size_t kMostRemedies = 3;
// Steps of an optimisation: the first ones gain most.
constexpr std::uint64_t kSteps = 20;

// Costs of other sheets: new cuts cost more than new panels or springs.
constexpr double kSpringsCost = 0.3, kConstructionCost = 0.7, kOptimisationCost = 1;

bool mends(const CardKeys& keys, std::string_view key) {
  return std::ranges::find(keys, key) != keys.end();
}

class RemedySearch {
 public:
  RemedySearch(const Subject& subject, const StudiedCard& studied, const CardOptions& options,
               const std::string& path)
      : subject_(subject), studied_(studied), quick_(options), path_(path) {
    quick_.advice = Advice::none;
  }

  std::vector<Remedy> of(const CardLine& line) {
    key_ = line.key;
    remedies_.clear();
    part_ = part_of(line.key);
    for (const NumberChange& change : number_changes()) {
      try_number(change, line);
    }
    if (mends({"static_margin", "static_friction_n_mm_per_mm"}, key_)) try_springs(line);
    for (const SwitchChange& change : switch_changes()) {
      if (mends(change.mends, key_)) try_switch(change);
    }
    if (is_mended_by_shifts(key_)) try_constructions();
    if (remedies_.empty() && !crosses(line)) try_optimisation();
    std::vector<Remedy> remedies;
    for (auto& [cost, remedy] : remedies_) {
      if (remedies.size() < kMostRemedies) remedies.push_back(std::move(remedy));
    }
    return remedies;
  }

 private:
  using MakeVariant = std::function<CardVariant(double)>;

  // Returns whether two springs' axes cross, which no shift of vertices mends.
  bool crosses(const CardLine& line) const {
    return key_ == "spring_clearance_mm" && line.found &&
           *line.found <=
               solver::kSpringTouch_mm - subject_.model.design().spring_bodies().diameter_mm;
  }

  CardPart part_of(std::string_view key) const {
    for (std::size_t part = 0; part < kCardParts; ++part) {
      if (line_of(studied_.parts[part], key)) return static_cast<CardPart>(part);
    }
    return CardPart::path;
  }

  // The requirement's line with a value; none where it cannot be studied.
  std::optional<CardLine> line_of_value(const MakeVariant& make, double value) const {
    try {
      const CardVariant variant = make(value);
      const CardSheet on = variant.on();
      const std::vector<CardLine> lines = card_lines(part_, on, quick_);
      const CardLine* const line = line_of(lines, key_);
      return line ? std::optional(*line) : std::nullopt;
    } catch (const schema::UserError&) {
      return {};
    }
  }

  static Judged judged(const std::optional<CardLine>& line) {
    if (!line || !line->found) return {false, -std::numeric_limits<double>::infinity()};
    const double distance = *line->found - line->wanted.value_or(0);
    return {line->passes(), line->bound == CardLine::Bound::at_least ? distance : -distance};
  }

  // Reads the number off the requirement's line, or seeks it.
  void try_number(const NumberChange& change, const CardLine& line) {
    const Design& design = subject_.model.design();
    const std::optional<double>& named = design.*change.number;
    const auto row =
        std::ranges::find(schema::design_numbers(), change.number, &schema::DesignNumber::number);
    const double start = named.value_or(0) > 0 ? *named : change.usual;
    if (start == 0 || (row->block == "springs" && !design.is_springs())) return;
    const MakeVariant make = [&](double value) {
      Design changed = design;
      changed.*change.number = value;
      if (change.also) change.also(changed);
      return CardVariant(subject_, changed);
    };
    const auto propose = [&](double value, bool is_up) {
      const double shown = std::clamp(two_digits(value, is_up ? Rounding::up : Rounding::down),
                                      row->least, row->most);
      add(
          fmt::format(fmt::runtime(change.what), shown),
          fmt::format("{} = {:.10g}{}{}", schema::key_of(*row, design), shown,
                      change.also ? ", " : "", change.also_typed),
          [&] { return make(shown); }, std::abs(std::log(shown / start)));
    };
    if (mends(change.limited_by, key_) && line.found && *line.found > 0) {
      return propose(*line.found, change.way == Way::up);
    }
    if (mends(change.margins, key_) && line.found && *line.found > -1) {
      return propose(start * (1 + *line.found) / (1 + *line.wanted), false);
    }
    if (!mends(change.mends, key_)) return;
    const bool is_none = named.value_or(row->standard.value_or(start)) == 0;
    for (const bool is_up : {true, false}) {
      if (change.way == (is_up ? Way::down : Way::up) || (!is_up && is_none)) continue;
      const auto value =
          least_change(start, judged(line).score,
                       {is_up ? change.factor : 1 / change.factor, row->least, row->most},
                       [&](double tried) { return judged(line_of_value(make, tried)); });
      if (value) propose(*value, is_up);
    }
  }

  // Springs of another rate with the preload that is best for it by linear bending: nearest rates
  // first.
  void try_springs(const CardLine& line) {
    const Design& design = subject_.model.design();
    const CardSheet on = studied_sheet();
    const double friction = release_of(on).sheet.joints.friction_n_mm_per_mm,
                 wanted = line.wanted.value_or(0) * friction + friction,
                 start = design.springs().stiffness_n_per_mm;
    std::vector<double> rates_n_per_mm;
    for (const double factor : {1.0, 0.5, 2.0, 0.25, 4.0, 0.125, 8.0}) {
      rates_n_per_mm.push_back(two_digits(start * factor));
    }
    for (const PreloadedSprings& springs : preloaded_springs(on, rates_n_per_mm)) {
      if (!(springs.static_n_mm_per_mm >= wanted)) continue;
      Design changed = with_springs(design, springs);
      const bool is_latched = design.preload_n.value_or(0) == 0;
      if (is_latched) changed.hold_flat = true;
      const std::size_t before = remedies_.size();
      add(
          fmt::format("springs of {:g} N/mm with {:g} N left at flat{}",
                      *changed.stiffness_n_per_mm, *changed.preload_n,
                      is_latched ? ", and a latch" : ""),
          fmt::format("design.springs.stiffness_n_per_mm = {:g}, preload_n = {:g}{}",
                      *changed.stiffness_n_per_mm, *changed.preload_n,
                      is_latched ? ", design.hold_flat = true" : ""),
          [&] { return CardVariant(subject_, changed); },
          kSpringsCost + std::abs(std::log(springs.stiffness_n_per_mm / start)));
      if (remedies_.size() > before) return;
    }
  }

  void try_switch(const SwitchChange& change) {
    Design changed = subject_.model.design();
    change.make(changed);
    if (!changed.is_springs()) return;
    add(
        change.what, change.typed, [&] { return CardVariant(subject_, changed); }, change.cost);
  }

  // A sheet of the base's parallel family at the angle of use, with the sheet's largest shift; with
  // larger ones where that is not enough.
  void try_constructions() {
    const ChosenSheet& chosen = subject_.chosen;
    const double start_mm = chosen.shifts_mm.cwiseAbs().maxCoeff(), at_deg = studied_.card.from_deg;
    if (start_mm <= 0) return;
    const bool with_rim = has_shifted_rim();
    const MakeVariant make = [&](double amplitude_mm) {
      solver::ConstructOptions construct;
      construct.amplitude_mm = amplitude_mm;
      construct.at_deg = at_deg;
      return CardVariant(subject_,
                         constructed(chosen.base, chosen.name(), with_rim, construct).shifts_mm);
    };
    const auto as_it_is = line_of_value(make, start_mm);
    if (!as_it_is) return;
    double amplitude_mm = start_mm;
    if (!as_it_is->passes()) {
      const auto larger_mm =
          least_change(start_mm, judged(as_it_is).score, {1.5, start_mm, 1e3 * start_mm},
                       [&](double tried_mm) { return judged(line_of_value(make, tried_mm)); });
      if (!larger_mm) return;
      amplitude_mm = two_digits(*larger_mm, Rounding::up);
    }
    add(
        fmt::format("a construction at {:.4g}° with shifts up to {:.3g} mm", at_deg, amplitude_mm),
        fmt::format(
            "{}misalign construct {} --at {:.10g} --amplitude {:.10g}{} --output better.json",
            export_words(), base_words(), at_deg, amplitude_mm, with_rim ? " --rim" : ""),
        [&] { return make(amplitude_mm); }, kConstructionCost + std::log(amplitude_mm / start_mm));
  }

  void try_optimisation() {
    const char* const goal = goal_towards(key_);
    if (goal == nullptr) return;
    OptimiseInput input;
    input.goal = solver::goal_named(goal);
    input.most_steps = kSteps;
    input.tries_flips = false;
    input.jobs = quick_.jobs;
    if (subject_.model.design().from_deg) input.deploys_from_deg = studied_.card.from_deg;
    const auto make = [&] {
      return CardVariant(better_pattern(subject_, optimised(subject_, input)));
    };
    add(fmt::format("an optimisation of its {}", input.goal->words),
        fmt::format("misalign optimise {} --goal {} --steps {} --output better.json", sheet_words(),
                    goal, kSteps),
        make, kOptimisationCost);
  }

  bool has_shifted_rim() const {
    const std::vector<int> inner = solver::interior_vertices(subject_.sheet.base().sheet);
    const Eigen::Matrix2Xd& shifts_mm = subject_.chosen.shifts_mm;
    for (int vertex = 0; vertex < static_cast<int>(shifts_mm.cols()); ++vertex) {
      const bool is_inner = std::ranges::find(inner, vertex) != inner.end();
      if (!is_inner && shifts_mm.col(vertex).cwiseAbs().maxCoeff() > 0) return true;
    }
    return false;
  }

  // Stops of copies are those of their filling.
  bool has_same_copies(const Design& design) const {
    const Design& before = subject_.model.design();
    return design.miscut_mm == before.miscut_mm && design.play_mm == before.play_mm &&
           studied_sheet().stop_deg() == 0;
  }

  CardSheet studied_sheet() const { return card_sheet(subject_); }

  std::string sheet_words() const {
    const auto& drawn = subject_.chosen.drawn;
    return shell_path(path_) + (drawn ? " " + std::to_string(drawn->draw) : "");
  }

  // A draw is constructed from its exported file.
  std::string export_words() const {
    const auto& drawn = subject_.chosen.drawn;
    if (!drawn) return "";
    return fmt::format("misalign export {} --draw {} --output base; ", shell_path(path_),
                       drawn->draw);
  }
  std::string base_words() const {
    const auto& drawn = subject_.chosen.drawn;
    if (!drawn) return shell_path(path_);
    return shell_path(fmt::format("base/{}-{}.json", drawn->campaign.name, drawn->draw));
  }

  // Adds a change whose card meets the requirement, and all that were met before.
  void add(const std::string& what, const std::string& typed,
           const std::function<CardVariant()>& make, double cost) {
    try {
      const CardVariant variant = make();
      CardParts same;
      const auto take = [&](CardPart part) {
        const auto k = static_cast<std::size_t>(part);
        same[k] = studied_.parts[k];
      };
      if (variant.has_same_path()) {
        take(CardPart::path);
        if (has_same_copies(variant.on().design)) take(CardPart::copies);
      }
      const schema::Card card = card_of(variant.on(), quick_, std::move(same)).card;
      for (const CardLine& line : card.lines) {
        const CardLine* const before = line_of(studied_.card.lines, line.key);
        const bool has_passed = before == nullptr || before->passes();
        if (!line.passes() && (has_passed || line.key == key_)) return;
      }
      remedies_.emplace(
          cost, Remedy{std::string(key_), what, typed, schema::prices_of(studied_.card, card, key_),
                       card.passes(), variant.pattern_file()});
    } catch (const schema::UserError&) {
      return;  // no sheet, or none that has a card
    }
  }

  const Subject& subject_;
  const StudiedCard& studied_;
  CardOptions quick_;  // without advice, which costs most
  const std::string path_;
  std::string_view key_;  // of the requirement that is to be met
  CardPart part_ = CardPart::path;
  std::multimap<double, Remedy> remedies_;  // keys: costs
};

}  // namespace

std::vector<Remedy> remedies_of(const Subject& subject, const StudiedCard& studied,
                                const CardOptions& options, const std::string& path) {
  RemedySearch search(subject, studied, options, path);
  std::vector<Remedy> remedies;
  for (const CardLine& line : studied.card.lines) {
    if (line.passes()) continue;
    std::ranges::move(search.of(line), std::back_inserter(remedies));
  }
  return remedies;
}

}  // namespace misalign::search
