#include "search/sheets/backlash_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace misalign::search {
namespace {

using schema::Json;
using solver::BacklashTrial;
using solver::BranchEnd;

constexpr double kTrialShares[] = {0, 0.05, 0.25, 0.5, 0.75, 0.95, 1};

// Values of the trials that have one, in order.
template <class Value>
std::vector<double> sorted(const Backlash& backlash, Value value_of) {
  std::vector<double> values;
  for (const BacklashTrial& trial : backlash.trials) {
    if (const std::optional<double> value = value_of(trial)) values.push_back(*value);
  }
  std::sort(values.begin(), values.end());
  return values;
}

std::vector<double> lost_deg(const Backlash& backlash) {
  return sorted(backlash, [](const BacklashTrial& trial) {
    return trial.lost == BranchEnd::not_known ? std::nullopt : std::optional(trial.lost_deg);
  });
}

std::vector<double> one_way_from_deg(const Backlash& backlash) {
  return sorted(backlash, [](const BacklashTrial& trial) {
    return trial.is_known ? std::optional(trial.one_way_from_deg) : std::nullopt;
  });
}

std::vector<double> one_way_to_deg(const Backlash& backlash) {
  return sorted(backlash, [](const BacklashTrial& trial) {
    return trial.is_known ? std::optional(trial.one_way_to_deg) : std::nullopt;
  });
}

// In backlashes: what is left over round whole vertices.
std::vector<double> gaps(const Backlash& backlash) {
  return sorted(backlash, [&](const BacklashTrial& trial) {
    return std::optional(trial.gap_widths * backlash.panel_width_mm / backlash.backlash_mm);
  });
}

// That this share of the values stays at or below, at least one.
double quantile(const std::vector<double>& values, double share) {
  const auto count = std::max(1.0, std::ceil(share * static_cast<double>(values.size())));
  return values[static_cast<std::size_t>(count) - 1];
}

std::string quantiles_line(const char* what, const std::vector<double>& values) {
  std::string text = fmt::format("{:<18}", what);
  if (values.empty()) return text + "not known\n";
  for (const double share : kTrialShares) {
    text += fmt::format(" {:.4g} deg ({:g} %)", quantile(values, share), 100 * share);
  }
  return text + "\n";
}

Json quantiles_json(const std::vector<double>& values, const char* name) {
  Json quantiles = Json::array();
  if (values.empty()) return quantiles;
  for (const double share : kTrialShares) {
    quantiles.push_back({{"share", share}, {name, quantile(values, share)}});
  }
  return quantiles;
}

ShareOfTrials one_way_share(const Backlash& backlash, double up_to_deg) {
  return share_of(backlash.one_way_to(up_to_deg), backlash.undecided(), backlash.trials.size());
}

std::string share_line(const Backlash& backlash, double up_to_deg) {
  const ShareOfTrials share = one_way_share(backlash, up_to_deg);
  return fmt::format("one way {:g} to {:<6g} {}, {:.4g} % (95 %: {:.4g} to {:.4g})\n",
                     backlash.from_deg, up_to_deg, backlash.one_way_to(up_to_deg),
                     100 * share.share, 100 * share.low, 100 * share.high);
}

Json share_json(const Backlash& backlash, double up_to_deg) {
  const ShareOfTrials share = one_way_share(backlash, up_to_deg);
  return {{"to_deg", up_to_deg},
          {"trials", backlash.one_way_to(up_to_deg)},
          {"share", share.share},
          {"share_low", share.low},
          {"share_high", share.high}};
}

std::string largest_words(const Backlash& backlash) {
  if (backlash.largest_mm == 0) return fmt::format("below {:g} mm", backlash.least_mm);
  if (backlash.largest_mm >= backlash.most_mm)
    return fmt::format("{:g} mm and more", backlash.most_mm);
  return fmt::format("{:.3g} mm", backlash.largest_mm);
}

// Which faults end the stretch, the commonest in a legend first.
std::string faults_line(const Backlash& backlash) {
  std::string text;
  for (const solver::FaultEntry& entry : solver::fault_table()) {
    const auto count = std::count_if(
        backlash.trials.begin(), backlash.trials.end(), [&](const BacklashTrial& trial) {
          return trial.is_known && trial.fault == entry.fault && entry.fault != solver::Fault::none;
        });
    if (count > 0) text += fmt::format(" {} {}", count, entry.name);
  }
  return text.empty() ? "" : fmt::format("{:<18}{}\n", "ended by", text);
}

Json faults_json(const Backlash& backlash) {
  Json faults = Json::object();
  for (const BacklashTrial& trial : backlash.trials) {
    if (!trial.is_known || trial.fault == solver::Fault::none) continue;
    auto& count = faults[solver::fault_name(trial.fault)];
    count = count.is_null() ? 1 : count.get<int>() + 1;
  }
  return faults;
}

const char* name_of(BranchEnd end) {
  switch (end) {
    case BranchEnd::flat:
      return "flat";
    case BranchEnd::turns:
      return "turns";
    case BranchEnd::other_branch:
      return "other_branch";
    default:
      return "not_known";
  }
}

}  // namespace

std::string backlash_text(const NamedBacklash& named) {
  const Backlash& backlash = named.backlash;
  std::string text =
      fmt::format("{}, deploys from {:g} deg; {} trials, every joint off by up to {:g} mm\n",
                  named.name, backlash.own_deg, backlash.trials.size(), backlash.backlash_mm);
  text += quantiles_line("branch lost at", lost_deg(backlash));
  text += quantiles_line("one way down to", one_way_from_deg(backlash));
  text += quantiles_line("one way up to", one_way_to_deg(backlash));
  const std::vector<double> left = gaps(backlash);
  text += fmt::format(
      "{:<18} {:.3g} backlashes, at most {:.3g}: what play at whole vertices has to "
      "take up\n",
      "left over", quantile(left, 0.5), left.back());
  text += faults_line(backlash);
  if (backlash.undecided() > 0) {
    text +=
        fmt::format("undecided          {}: the intervals allow for both\n", backlash.undecided());
  }
  text += share_line(backlash, backlash.own_deg);
  if (named.threshold_deg &&
      *named.threshold_deg<backlash.own_deg&& * named.threshold_deg> backlash.from_deg) {
    text += share_line(backlash, *named.threshold_deg);
  }
  return text +
         fmt::format("{:g} % one way up to   {}\n", 100 * kWantedShare, largest_words(backlash));
}

std::string backlashes_text(std::vector<NamedBacklash> several) {
  std::stable_sort(several.begin(), several.end(), [](const auto& a, const auto& b) {
    return a.backlash.largest_mm < b.backlash.largest_mm;
  });
  const Backlash& first = several.front().backlash;
  std::string text = fmt::format(
      "{} trials each, every joint off by up to {:g} mm; the most tolerant last\n"
      "{:24}  deploys from  one way from {:<6g} 95 %             branch lost at  {:g} % up to\n",
      first.trials.size(), first.backlash_mm, "", first.from_deg, 100 * kWantedShare);
  for (const NamedBacklash& named : several) {
    const Backlash& backlash = named.backlash;
    const ShareOfTrials share = one_way_share(backlash, backlash.own_deg);
    const std::vector<double> lost = lost_deg(backlash);
    text += fmt::format(
        "{:<24}  {:>12g}  {:>17.4g} % {:<16} {:>10} deg  {}\n", named.name, backlash.own_deg,
        100 * share.share, fmt::format("{:.4g} to {:.4g}", 100 * share.low, 100 * share.high),
        lost.empty() ? "?" : fmt::format("{:.3g}", quantile(lost, 0.5)), largest_words(backlash));
  }
  return text;
}

Json backlash_json(const NamedBacklash& named) {
  const Backlash& backlash = named.backlash;
  const std::vector<double> left = gaps(backlash);
  Json ends = Json::object();
  for (const BranchEnd end :
       {BranchEnd::flat, BranchEnd::turns, BranchEnd::other_branch, BranchEnd::not_known}) {
    ends[name_of(end)] =
        std::count_if(backlash.trials.begin(), backlash.trials.end(),
                      [&](const BacklashTrial& trial) { return trial.lost == end; });
  }
  Json largest = nullptr;
  if (backlash.largest_mm > 0) {
    largest = {{"backlash_mm", backlash.largest_mm},
               {"wanted_share", kWantedShare},
               {"trials", backlash.with_largest}};
    largest["is_most"] = backlash.largest_mm >= backlash.most_mm;
  }
  Json json = {
      {"backlash_mm", backlash.backlash_mm},
      {"trials", backlash.trials.size()},
      {"undecided", backlash.undecided()},
      {"from_deg", backlash.from_deg},
      {"deploys_from_deg", backlash.own_deg},
      {"one_way", share_json(backlash, backlash.own_deg)},
      {"largest", largest},
      {"faults", faults_json(backlash)},
      {"branch_ends", ends},
      {"lost", quantiles_json(lost_deg(backlash), "lost_deg")},
      {"one_way_from", quantiles_json(one_way_from_deg(backlash), "from_deg")},
      {"one_way_up_to", quantiles_json(one_way_to_deg(backlash), "to_deg")},
      {"left_over_backlashes", {{"median", quantile(left, 0.5)}, {"largest", left.back()}}}};
  if (named.threshold_deg && *named.threshold_deg > backlash.from_deg) {
    json["one_way_to_threshold"] = share_json(backlash, *named.threshold_deg);
  }
  return json;
}

}  // namespace misalign::search
