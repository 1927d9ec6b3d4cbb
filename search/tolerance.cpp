#include "search/tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "schema/share_interval.hpp"
#include "search/draw.hpp"

namespace misalign::search {
namespace {

using schema::Json;

constexpr std::uint64_t kSheetsAtOnce = 1024;

std::vector<int> all_vertices(const solver::CreasePattern& sheet) {
  std::vector<int> vertices(static_cast<std::size_t>(sheet.vertex_count()));
  std::iota(vertices.begin(), vertices.end(), 0);
  return vertices;
}

// Copies of one candidate, every vertex anywhere near its place.
class Copies {
 public:
  Copies(const schema::Campaign& campaign, const Eigen::Matrix2Xd& shifts_mm, double amplitude_mm,
         solver::InstructionSet set)
      : campaign_(campaign),
        shifts_mm_(shifts_mm),
        amplitude_mm_(amplitude_mm),
        family_(campaign.pattern.base, all_vertices(campaign.pattern.base.sheet), campaign.path(),
                campaign.threshold_sample(), campaign.between_samples),
        batch_(solver::make_batch(set, family_)) {}

  int own_sample() {
    begin(1);
    place(0, Eigen::Matrix2Xd::Zero(2, shifts_mm_.cols()));
    return judge().front().deploys_from_sample;
  }

  /// Trials with the errors of one vertex only, or of all if it is negative.
  MiscutCopies count(std::uint64_t trials, int vertex, int own_sample) {
    MiscutCopies copies;
    Eigen::Matrix2Xd errors_mm(2, shifts_mm_.cols()), kept_mm(2, shifts_mm_.cols());
    for (std::uint64_t first = 0; first < trials; first += kSheetsAtOnce) {
      const auto sheets = static_cast<int>(std::min(kSheetsAtOnce, trials - first));
      begin(sheets);
      for (int k = 0; k < sheets; ++k) {
        trial_errors(campaign_, amplitude_mm_, first + static_cast<std::uint64_t>(k),
                     errors_mm.data());
        if (vertex >= 0) {
          kept_mm.setZero();
          kept_mm.col(vertex) = errors_mm.col(vertex);
          errors_mm.swap(kept_mm);
        }
        place(k, errors_mm);
      }
      for (const solver::Verdict& verdict : judge()) {
        copies.add(verdict, campaign_.threshold_sample(), own_sample);
      }
    }
    std::sort(copies.samples.begin(), copies.samples.end());
    return copies;
  }

 private:
  void begin(int sheets) {
    block_.sheets = sheets;
    block_.shifts_mm.resize(static_cast<std::size_t>(shifts_mm_.size() * sheets));
  }
  void place(int sheet, const Eigen::Matrix2Xd& errors_mm) {
    Eigen::Map<Eigen::Matrix2Xd>(block_.shifts_mm.data() + shifts_mm_.size() * sheet, 2,
                                 shifts_mm_.cols()) = shifts_mm_ + errors_mm;
  }
  std::vector<solver::Verdict> judge() { return judge_to_the_end(family_, *batch_, block_); }

  const schema::Campaign& campaign_;
  const Eigen::Matrix2Xd shifts_mm_;
  const double amplitude_mm_;
  const solver::SheetFamily family_;
  const std::unique_ptr<solver::Batch> batch_;
  solver::ShiftBlock block_;
};

void refuse_lost_convexity(const solver::CreasePattern& base, const Eigen::Matrix2Xd& shifts_mm,
                           double amplitude_mm) {
  solver::CreasePattern sheet = base;
  sheet.vertices_mm += shifts_mm;
  const double safe_mm = solver::largest_safe_amplitude_mm(sheet, all_vertices(sheet));
  if (amplitude_mm < safe_mm) return;
  throw schema::UserError(schema::kExitUsage,
                          "--amplitude " + schema::shown_number(amplitude_mm) + ": must be below " +
                              schema::shown_number(safe_mm) +
                              " mm (where a facet of this sheet can lose convexity); try 0.1");
}

Json share_json(std::uint64_t hits, const MiscutCopies& copies) {
  const ShareOfTrials share = share_of(hits, copies);
  return {{"copies", hits},
          {"share", share.share},
          {"share_low", share.low},
          {"share_high", share.high}};
}

constexpr double kQuantiles[] = {0, 0.05, 0.25, 0.5, 0.75, 0.95, 1};

}  // namespace

void trial_errors(const schema::Campaign& campaign, double amplitude_mm, std::uint64_t trial,
                  double* errors_mm) {
  const schema::Misalignment errors{all_vertices(campaign.pattern.base.sheet), amplitude_mm,
                                    schema::Levels::uniform};
  draw_shifts(errors, campaign.seed, trial, errors_mm, kToleranceStream);
}

void MiscutCopies::add(const solver::Verdict& verdict, int threshold_sample, int own_sample) {
  ++trials;
  if (verdict.first_fault == solver::Fault::undecided) {
    ++undecided;
    return;
  }
  from_threshold += verdict.deploys_from_sample >= threshold_sample;
  from_own += verdict.deploys_from_sample >= own_sample;
  samples.push_back(verdict.deploys_from_sample);
}

int MiscutCopies::quantile(double share) const {
  if (samples.empty()) return 0;
  const auto count =
      static_cast<std::size_t>(std::ceil(share * static_cast<double>(samples.size())));
  return samples[std::max<std::size_t>(count, 1) - 1];
}

double MiscutCopies::mean_sample() const {
  if (samples.empty()) return 0;
  return std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
}

ShareOfTrials share_of(std::uint64_t hits, const MiscutCopies& copies) {
  const std::uint64_t decided = copies.trials - copies.undecided;
  const auto [low, high] = schema::share_interval(hits, copies.undecided, copies.trials);
  return {decided > 0 ? static_cast<double>(hits) / static_cast<double>(decided) : 0, low, high};
}

Tolerance study_tolerance(const schema::Campaign& campaign, std::uint64_t draw, double amplitude_mm,
                          std::uint64_t trials, solver::InstructionSet set) {
  const solver::CreasePattern& sheet = campaign.pattern.base.sheet;
  Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, sheet.vertex_count());
  draw_shifts(campaign.misalignment, campaign.seed, draw, shifts_mm);
  refuse_lost_convexity(sheet, shifts_mm, amplitude_mm);
  Copies copies(campaign, shifts_mm, amplitude_mm, set);
  const int own_sample = copies.own_sample();
  Tolerance tolerance{draw,
                      amplitude_mm,
                      campaign.sample_deg,
                      campaign.threshold_deg,
                      own_sample,
                      copies.count(trials, -1, own_sample),
                      {}};
  const std::uint64_t of_one = std::min(trials, kMostTrialsOfOneVertex);
  for (int v = 0; v < sheet.vertex_count(); ++v) {
    tolerance.vertices.push_back({v, copies.count(of_one, v, own_sample)});
  }
  const auto harm = [&](const VertexTolerance& vertex) {
    return std::pair(-share_of(vertex.copies.from_threshold, vertex.copies).share,
                     tolerance.mean_loss_deg(vertex.copies));
  };
  std::stable_sort(tolerance.vertices.begin(), tolerance.vertices.end(),
                   [&](const auto& a, const auto& b) { return harm(a) > harm(b); });
  return tolerance;
}

std::string tolerance_text(const Tolerance& t) {
  char line[200];
  std::string text;
  const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  std::snprintf(line, sizeof line,
                "draw %llu, deploys from %g deg; %llu copies, every vertex off by up to %g mm\n",
                number(t.draw), t.own_sample * t.sample_deg, number(t.copies.trials),
                t.amplitude_mm);
  text += line;
  const auto add_share = [&](double deg, std::uint64_t hits) {
    const ShareOfTrials share = share_of(hits, t.copies);
    std::snprintf(line, sizeof line, "still from %-6g %llu, %.4g %% (95 %%: %.4g to %.4g)\n", deg,
                  number(hits), 100 * share.share, 100 * share.low, 100 * share.high);
    text += line;
  };
  add_share(t.threshold_deg, t.copies.from_threshold);
  if (t.own_sample * t.sample_deg > t.threshold_deg) {
    add_share(t.own_sample * t.sample_deg, t.copies.from_own);
  }
  if (t.copies.undecided > 0) {
    std::snprintf(line, sizeof line, "undecided         %llu: the intervals allow for both\n",
                  number(t.copies.undecided));
    text += line;
  }
  text += "deploy from      ";
  for (const double share : kQuantiles) {
    std::snprintf(line, sizeof line, " %g deg (%g %%)", t.copies.quantile(share) * t.sample_deg,
                  100 * share);
    text += line;
  }
  std::snprintf(line, sizeof line,
                "\n\none vertex alone, %llu copies each, the most harmful first\n"
                "vertex  still from %g  mean loss, deg\n",
                number(t.vertices.front().copies.trials), t.threshold_deg);
  text += line;
  for (const VertexTolerance& vertex : t.vertices) {
    std::snprintf(line, sizeof line, "%-6s %12.4g %% %15.4g\n",
                  solver::vertex_label(vertex.vertex).c_str(),
                  100 * share_of(vertex.copies.from_threshold, vertex.copies).share,
                  t.mean_loss_deg(vertex.copies));
    text += line;
  }
  return text;
}

Json tolerance_json(const Tolerance& t) {
  Json quantiles = Json::array(), vertices = Json::array();
  for (const double share : kQuantiles) {
    quantiles.push_back(
        {{"share", share}, {"deploys_from_deg", t.copies.quantile(share) * t.sample_deg}});
  }
  for (const VertexTolerance& vertex : t.vertices) {
    Json json = share_json(vertex.copies.from_threshold, vertex.copies);
    json["vertex"] = solver::vertex_label(vertex.vertex);
    json["trials"] = vertex.copies.trials;
    json["undecided"] = vertex.copies.undecided;
    json["mean_loss_deg"] = t.mean_loss_deg(vertex.copies);
    vertices.push_back(json);
  }
  return {{"draw", t.draw},
          {"amplitude_mm", t.amplitude_mm},
          {"trials", t.copies.trials},
          {"undecided", t.copies.undecided},
          {"deploys_from_deg", t.own_sample * t.sample_deg},
          {"threshold_deg", t.threshold_deg},
          {"from_threshold", share_json(t.copies.from_threshold, t.copies)},
          {"from_own", share_json(t.copies.from_own, t.copies)},
          {"mean_loss_deg", t.mean_loss_deg(t.copies)},
          {"quantiles", quantiles},
          {"vertices", vertices}};
}

}  // namespace misalign::search
