#include "search/designs/designer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <tuple>

#include "schema/files/hash.hpp"
#include "search/designs/number_choice.hpp"
#include "search/sheets/better_sheet.hpp"
#include "search/sheets/card_changes.hpp"
#include "search/sheets/card_limits.hpp"
#include "search/sheets/on_threads.hpp"
#include "search/terminal/build_info.hpp"
#include "search/terminal/long_work.hpp"

namespace misalign::search {
namespace {

// Cards of a rough design, of a refined one, and of the best; the numbers of sheets that are
// refined and optimised, and the steps of an optimisation.
constexpr int kRoughCards = 4, kRefinedCards = 12, kBestCards = 30;
constexpr std::size_t kRefined = 3, kOptimised = 2;
constexpr std::uint32_t kSteps = 30;

class Designer {
 public:
  Designer(const schema::Wish& wish, const DesignerOptions& options)
      : wish_(wish),
        options_(options),
        sources_(sheet_sources(wish, options.sources)),
        log_(options.log_path, request()) {}

  std::vector<DesignTry> all() {
    std::vector<Step> steps;
    for (const SheetSource& source : sources_) {
      steps.push_back({source.how, [this, &source] {
                         std::vector<DesignTry> tries;
                         for (const MadeSheet& sheet : source.make()) {
                           tries.push_back(tried(sheet, DesignStage::rough, kRoughCards));
                         }
                         return tries;
                       }});
    }
    take(steps, "sheets tried");
    take(refining_steps("refined", kRefined, kRefinedCards), "designs refined");
    take(refining_steps("refined further", 1, kBestCards), "designs refined further");
    take(optimising_steps(), "sheets optimised");
    return std::move(tries_);
  }

 private:
  // Fingerprint of all that tries depend on.
  std::string request() const {
    std::string text = fmt::format("{} {} {} {} {}", build_info().version, wish_.text,
                                   options_.sources.draws, options_.sources.seed, options_.trials);
    for (const SheetSource& source : sources_) text += source.base;
    return schema::hex(schema::hash_of(text));
  }

  struct Step {
    std::string name;
    std::function<std::vector<DesignTry>()> take;
  };

  // Takes steps in any order, and adds their tries in turn; finished ones are in the log.
  void take(const std::vector<Step>& steps, const char* counted) {
    std::vector<const Step*> open;
    for (const Step& step : steps) {
      if (log_.find(step.name) == nullptr) open.push_back(&step);
    }
    std::size_t done = steps.size() - open.size();
    show_work(counted, done, steps.size());
    on_threads(
        static_cast<std::size_t>(options_.jobs), open.size(),
        [&](std::size_t) { return [&](std::size_t k) { return open[k]->take(); }; },
        [&](std::size_t k, std::vector<DesignTry> tries) {
          log_.add(open[k]->name, std::move(tries));
          show_work(counted, ++done, steps.size());
          return true;
        });
    for (const Step& step : steps) {
      for (const DesignTry& tried : *log_.find(step.name)) replace(tried);
    }
    std::ranges::stable_sort(tries_, [](const DesignTry& a, const DesignTry& b) {
      return std::tuple(a.pattern.is_null(), -a.score.value) <
             std::tuple(b.pattern.is_null(), -b.score.value);
    });
  }

  // A refined design takes the place of its rough one, where it is no worse.
  void replace(const DesignTry& tried) {
    const auto same = std::ranges::find_if(tries_, [&](const DesignTry& other) {
      return tried.stage != DesignStage::optimised && other.how == tried.how;
    });
    if (same == tries_.end()) {
      tries_.push_back(tried);
    } else if (!tried.pattern.is_null() && tried.score.value >= same->score.value) {
      *same = tried;
    }
  }

  // The best tries, while they have too little reserve.
  std::vector<const DesignTry*> to_improve() const {
    std::vector<const DesignTry*> found;
    for (const DesignTry& best : tries_) {
      if (best.pattern.is_null() || best.score.value >= kMostReserve) break;
      found.push_back(&best);
    }
    return found;
  }

  std::vector<Step> refining_steps(const std::string& name, std::size_t most, int cards) {
    std::vector<Step> steps;
    for (const DesignTry* const best : to_improve()) {
      if (steps.size() == most) break;
      steps.push_back({name + ": " + best->how, [this, best = *best, cards] {
                         const MadeSheet sheet{best.how, best.pattern, ""};
                         return std::vector{tried(sheet, DesignStage::refined, cards)};
                       }});
    }
    return steps;
  }

  std::vector<Step> optimising_steps() {
    std::vector<Step> steps;
    for (const DesignTry* const best : to_improve()) {
      if (steps.size() == kOptimised) break;
      if (!can_be_optimised(*best)) continue;
      steps.push_back({"optimised: " + best->how, [this, best = *best] {
                         return std::vector{
                             tried(optimised_sheet(best), DesignStage::optimised, kBestCards)};
                       }});
    }
    return steps;
  }

  DesignTry tried(const MadeSheet& sheet, DesignStage stage, int cards) const {
    DesignTry tried{sheet.how, stage, nullptr, sheet.why, "", {}, {}};
    if (sheet.pattern.is_null()) return tried;
    try {
      const Subject subject(sheet_of_made_pattern(sheet.pattern, sheet.how), {});
      const CardSheet on = card_sheet(subject);
      NumberChoice choice = choose_numbers(
          on, wish_.free, cards,
          stage == DesignStage::refined ? ChoiceStarts::design : ChoiceStarts::springs);
      const CardSheet chosen{on.chosen, on.sheet, choice.design, on.used_deg};
      const schema::Card card =
          card_of(chosen, {.trials = options_.trials, .advice = Advice::none}, choice.parts).card;
      tried.pattern = schema::pattern_file_json(
          on.chosen.base, on.chosen.shifts_mm, on.chosen.sampling, choice.design, on.chosen.target);
      tried.chosen = chosen_words(choice.design, wish_.free);
      tried.score = score_of(card.lines);
      for (const schema::CardLine& line : card.lines) {
        if (!line.passes()) tried.lacks.push_back(short_label(line.what));
      }
    } catch (const schema::UserError& error) {
      tried.why = error.what();
    }
    return tried;
  }

  // Ascents change free shifts, keep no shape, and know springs that push, too.
  bool can_be_optimised(const DesignTry& best) const {
    if (!wish_.free.amplitude_mm || goal_towards(best.score.key) == nullptr) return false;
    const ChosenSheet chosen = as_pushing(best.pattern, best.how);
    return !chosen.target && solver::are_like_springs(chosen.design.fill(chosen.base.base));
  }

  static ChosenSheet as_pushing(const schema::Json& pattern, const std::string& name) {
    ChosenSheet chosen = sheet_of_made_pattern(pattern, name);
    chosen.design.pull_only.reset();
    return chosen;
  }

  // The sheet optimised towards the requirement that decides.
  MadeSheet optimised_sheet(const DesignTry& best) const {
    MadeSheet sheet{best.how, best.pattern, ""};
    OptimiseInput input;
    input.goal = solver::goal_named(goal_towards(best.score.key));
    input.most_steps = kSteps;
    input.tries_flips = false;
    input.amplitude_mm = wish_.free.amplitude_mm->back();
    input.with_rim = wish_.free.rim;
    input.trials = options_.trials;
    try {
      const schema::Json design = sheet.pattern.value("design", schema::Json::object());
      const Subject subject(as_pushing(sheet.pattern, sheet.how), {});
      input.deploys_from_deg = card_sheet(subject).used_deg;
      keep_card(subject, {.trials = input.trials, .advice = Advice::none}, input.bounds);
      sheet.pattern = better_pattern(subject, optimised(subject, input));
      sheet.pattern["design"] = design;
    } catch (const schema::UserError& error) {
      sheet.pattern = nullptr;
      sheet.why = error.what();
    }
    sheet.how = fmt::format("{}, optimised: {}", best.how, input.goal->words);
    return sheet;
  }

  const schema::Wish& wish_;
  const DesignerOptions& options_;
  const std::vector<SheetSource> sources_;
  DesignLog log_;
  std::vector<DesignTry> tries_;  // the best first
};

}  // namespace

std::vector<DesignTry> designs_for(const schema::Wish& wish, const DesignerOptions& options) {
  return Designer(wish, options).all();
}

}  // namespace misalign::search
