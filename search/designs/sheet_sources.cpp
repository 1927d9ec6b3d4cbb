#include "search/designs/sheet_sources.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "schema/files/hash.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "schema/pattern/perforation_check.hpp"
#include "search/designs/log_spaced.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/sheets/shaped.hpp"
#include "search/sheets/studies.hpp"
#include "search/splitting/climber.hpp"

namespace misalign::search {
namespace {

using schema::Candidate;

// Shifts to try between the least and the largest, evenly spaced in the logarithm.
constexpr int kAmplitudes = 3;
// The largest shift of draws, a share of a panel's width, and the accepted ones that are compared.
constexpr double kDrawnShare = 0.02;
constexpr std::size_t kAccepted = 100;
// A population where plain draws find none.
constexpr std::uint32_t kParticles = 500, kFirstDraws = 20000;

std::string shown_mm(double mm) { return fmt::format("{:.3g} mm", mm); }

// A base with its angle of use.
struct Base {
  schema::PatternFile file;
  schema::Free free;
  std::string source, label;  // the file's name, and its choices in words
  std::optional<double> from_deg;
  SourceOptions options;

  std::vector<double> amplitudes_mm() const {
    const auto [least, most] = *free.amplitude_mm;
    std::vector<double> amplitudes_mm = log_spaced(most, least, kAmplitudes);
    const auto is_same = [](double a, double b) { return shown_mm(a) == shown_mm(b); };
    amplitudes_mm.erase(std::unique(amplitudes_mm.begin(), amplitudes_mm.end(), is_same),
                        amplitudes_mm.end());
    return amplitudes_mm;
  }
  // Draws with larger shifts seldom deploy, and each takes a path of its own to its flat state.
  double drawn_amplitude_mm() const {
    const auto [least, most] = *free.amplitude_mm;
    return std::clamp(kDrawnShare * file.pattern.base.sheet.panel_width_mm, least, most);
  }
  std::string fingerprint() const {
    return schema::hex(schema::hash_of(pattern_of(file.pattern.shifts_mm).dump()));
  }
  schema::Json pattern_of(const Eigen::Matrix2Xd& shifts_mm) const {
    return schema::pattern_file_json(file.pattern, shifts_mm, file.sampling, file.design,
                                     file.target);
  }
};

using Make = std::function<std::vector<MadeSheet>(const Base&)>;

MadeSheet constructed_sheet(const Base& base, double amplitude_mm) {
  solver::ConstructOptions construct;
  construct.amplitude_mm = amplitude_mm;
  construct.at_deg = std::min(*base.from_deg, construct.at_deg);
  const auto study = constructed(base.file.pattern, base.source, base.free.rim, construct);
  return {"", base.pattern_of(study.shifts_mm), ""};
}

schema::Campaign campaign_of(const Base& base, double amplitude_mm) {
  const solver::CreasePattern& sheet = base.file.pattern.base.sheet;
  schema::Campaign campaign;
  campaign.name = base.source;
  campaign.pattern = base.file.pattern;
  campaign.misalignment.vertices =
      base.free.rim ? solver::all_vertices(sheet) : solver::interior_vertices(sheet);
  campaign.misalignment.amplitude_mm = amplitude_mm;
  campaign.misalignment.distribution = schema::ShiftDistribution::uniform;
  const schema::Sampling& sampling = base.file.sampling;
  campaign.sample_deg = sampling.sample_deg;
  campaign.end_deg = std::min(sampling.end_deg, campaign.pattern.base.folding.end_deg());
  campaign.threshold_deg =
      std::ceil(*base.from_deg / sampling.sample_deg - 1e-9) * sampling.sample_deg;
  campaign.between_samples = sampling.between_samples;
  if (sampling.energy_of) campaign.energy = schema::EnergyAcceptance{*sampling.energy_of};
  campaign.seed = base.options.seed;
  return campaign;
}

std::vector<Candidate> drawn(const schema::Campaign& campaign, std::uint64_t draws) {
  DrawEvaluator evaluator(campaign);
  std::vector<Candidate> accepted;
  constexpr std::uint64_t kAtOnce = 20000;
  for (std::uint64_t at = 0; at < draws && accepted.size() < kAccepted; at += kAtOnce) {
    schema::UnitRecord unit = work_off(evaluator, {at, std::min(draws, at + kAtOnce)});
    std::ranges::move(unit.candidates, std::back_inserter(accepted));
  }
  return accepted;
}

std::vector<Candidate> climbed_to(schema::Campaign campaign) {
  schema::Splitting& splitting = campaign.search.splitting.emplace();
  splitting.particles = kParticles;
  splitting.first_draws = kFirstDraws;
  Climber climber(campaign, solver::available_instruction_sets().back());
  const Ladder ladder = ladder_of(campaign, climber);
  std::vector<Candidate> candidates;
  for (FoundCandidate& met : climbed(ladder, 0, climber).found) {
    candidates.push_back(std::move(met.candidate));
  }
  return candidates;
}

// The candidates with the largest critical friction, and the largest margin over miscuts.
std::vector<MadeSheet> best_of(const Base& base, const std::vector<Candidate>& candidates) {
  const auto friction = [](const Candidate& candidate) {
    return candidate.metrics.critical_friction_n_mm_per_mm.value_or(0);
  };
  const auto margin = [](const Candidate& candidate) {
    return candidate.metrics.miscut_margin_mm.value_or(0);
  };
  const auto strongest = std::ranges::max_element(candidates, {}, friction),
             surest = std::ranges::max_element(candidates, {}, margin);
  std::vector<MadeSheet> best = {
      {", largest critical friction", base.pattern_of(strongest->shifts_mm), ""}};
  if (surest != strongest) {
    best.push_back({", largest miscut margin", base.pattern_of(surest->shifts_mm), ""});
  }
  return best;
}

std::vector<MadeSheet> drawn_sheets(const Base& base, double amplitude_mm) {
  if (schema::is_overconstrained(base.file.pattern.base)) {
    return {{"", {}, "no draw of an overconstrained sheet folds"}};
  }
  const schema::Campaign campaign = campaign_of(base, amplitude_mm);
  if (campaign.threshold_deg > campaign.end_deg) {
    return {{"", {}, fmt::format("the base folds to {:g}° only", campaign.end_deg)}};
  }
  std::vector<Candidate> candidates = drawn(campaign, base.options.draws);
  if (candidates.empty()) candidates = climbed_to(campaign);
  if (candidates.empty()) {
    return {{"",
             {},
             fmt::format("none of {} draws deploys from there, and no population reached one that "
                         "does",
                         base.options.draws)}};
  }
  return best_of(base, candidates);
}

std::vector<MadeSheet> shaped_sheets(const Base& base) {
  ShapeInput input;
  const ShapedSheet made = shaped(base.file, base.source, input);
  return {{"", shaped_pattern(base.file, made), ""}};
}

class SourceList {
 public:
  explicit SourceList(std::shared_ptr<const Base> base) : base_(std::move(base)) {}

  std::vector<SheetSource> all() {
    const bool has_shifts = base_->file.pattern.shifts_mm.cwiseAbs().maxCoeff() > 0;
    if (has_shifts || !base_->free.amplitude_mm) {
      add("own shifts", [](const Base& base) {
        return std::vector{MadeSheet{"", base.pattern_of(base.file.pattern.shifts_mm), ""}};
      });
    }
    // Other sheets do not have the shape.
    if (base_->file.target) add("shaped", shaped_sheets);
    if (base_->file.target || !base_->free.amplitude_mm) return std::move(sources_);
    for (const double amplitude_mm : base_->amplitudes_mm()) {
      add("constructed, shifts up to " + shown_mm(amplitude_mm), [amplitude_mm](const Base& base) {
        return std::vector{constructed_sheet(base, amplitude_mm)};
      });
    }
    if (base_->options.draws > 0) {
      const double amplitude_mm = base_->drawn_amplitude_mm();
      add("drawn, shifts up to " + shown_mm(amplitude_mm),
          [amplitude_mm](const Base& base) { return drawn_sheets(base, amplitude_mm); });
    }
    return std::move(sources_);
  }

 private:
  void add(const std::string& how, Make make) {
    sources_.push_back(
        {how + base_->label, base_->fingerprint(), [base = base_, how, make = std::move(make)] {
           std::vector<MadeSheet> made;
           try {
             made = make(*base);
           } catch (const schema::UserError& error) {
             made = {{"", {}, error.what()}};
           }
           for (MadeSheet& sheet : made) sheet.how = how + sheet.how + base->label;
           return made;
         }});
  }

  std::shared_ptr<const Base> base_;
  std::vector<SheetSource> sources_;
};

}  // namespace

std::vector<SheetSource> sheet_sources(const schema::Wish& wish, const SourceOptions& options) {
  std::vector<SheetSource> sources;
  for (const schema::WishChoice& choice : schema::choices_of(wish.free)) {
    Base base{schema::read_sampled_pattern(schema::wished_document(wish, choice), wish.source,
                                           wish.directory, schema::Perforations::any),
              wish.free,
              wish.source,
              choice.words(),
              {},
              options};
    base.from_deg = base.file.design.from_deg;
    if (!base.from_deg && !base.file.target) {
      throw schema::UserError(schema::Cause::bad_input,
                              wish.source +
                                  ": no angle of use is named, from which a sheet deploys; write "
                                  "\"from_deg\": 120 into \"design\", or \"from_deg\": [90, 150] "
                                  "into \"free\"");
    }
    auto more = SourceList(std::make_shared<const Base>(std::move(base))).all();
    std::ranges::move(more, std::back_inserter(sources));
  }
  return sources;
}

}  // namespace misalign::search
