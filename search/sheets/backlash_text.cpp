#include "search/sheets/backlash_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/exchange/backlash_json.hpp"
#include "solver/play/tolerance.hpp"

namespace misalign::search {
namespace {

std::string quantiles_line(const char* what, const std::vector<double>& values) {
  std::string text = fmt::format("{:<18}", what);
  if (values.empty()) return text + "not known\n";
  for (const double share : solver::kShownShares) {
    text += fmt::format(" {:.4g} deg ({:g} %)", solver::quantile(values, share), 100 * share);
  }
  return text + "\n";
}

std::string share_line(const solver::Backlash& backlash, double up_to_deg) {
  const schema::ShareOfTrials share = schema::one_way_share(backlash, up_to_deg);
  return fmt::format("monotone {:g} to {:<6g} {}, {:.4g} % (95 %: {:.4g} to {:.4g})\n",
                     backlash.from_deg, up_to_deg, backlash.one_way_to(up_to_deg),
                     100 * share.share, 100 * share.low, 100 * share.high);
}

std::string largest_words(const solver::Backlash& backlash) {
  if (backlash.largest_mm == 0) return fmt::format("below {:g} mm", backlash.least_mm);
  if (backlash.largest_mm >= backlash.most_mm)
    return fmt::format("{:g} mm and more", backlash.most_mm);
  return fmt::format("{:.3g} mm", backlash.largest_mm);
}

// Faults that end the monotone range, the commonest in a legend first.
std::string faults_line(const solver::Backlash& backlash) {
  std::string text;
  for (const solver::FaultEntry& entry : solver::fault_table()) {
    const auto count = std::count_if(
        backlash.trials.begin(), backlash.trials.end(), [&](const solver::BacklashTrial& trial) {
          return trial.is_known && trial.fault == entry.fault && entry.fault != solver::Fault::none;
        });
    if (count > 0) text += fmt::format(" {} {}", count, entry.name);
  }
  return text.empty() ? "" : fmt::format("{:<18}{}\n", "ended by", text);
}

}  // namespace

std::string backlash_text(const NamedBacklash& named) {
  const solver::Backlash& backlash = named.backlash;
  std::string text =
      fmt::format("{}, deploys from {:g} deg; {} trials, joint clearance {:g} mm\n", named.name,
                  backlash.own_deg, backlash.trials.size(), backlash.backlash_mm);
  text += quantiles_line("branch lost", backlash.lost_deg());
  text += quantiles_line("monotone, lowest", backlash.one_way_from_deg());
  text += quantiles_line("monotone, highest", backlash.one_way_to_deg());
  const std::vector<double> left = backlash.left_over();
  text += fmt::format(
      "{:<18} {:.3g} clearances, at most {:.3g}: play at whole vertices must close it\n",
      "residual gap", solver::quantile(left, 0.5), left.back());
  if (const std::vector<double> stops_deg = backlash.stops_deg(); !stops_deg.empty()) {
    text += quantiles_line(
        fmt::format("stops, {} of {}", stops_deg.size(), backlash.trials.size()).c_str(),
        stops_deg);
  }
  text += faults_line(backlash);
  if (backlash.undecided() > 0) {
    text += fmt::format("undecided          {}: the intervals allow both\n", backlash.undecided());
  }
  text += share_line(backlash, backlash.to_deg);
  if (named.threshold_deg &&
      *named.threshold_deg<backlash.to_deg&& * named.threshold_deg> backlash.from_deg) {
    text += share_line(backlash, *named.threshold_deg);
  }
  return text + fmt::format("{:g} % clearance     {}, from {:g} to {:g} deg\n",
                            100 * solver::kWantedShare, largest_words(backlash), backlash.from_deg,
                            backlash.to_deg);
}

std::string backlashes_text(std::vector<NamedBacklash> several) {
  std::stable_sort(several.begin(), several.end(), [](const auto& a, const auto& b) {
    return a.backlash.largest_mm < b.backlash.largest_mm;
  });
  const solver::Backlash& first = several.front().backlash;
  std::string text = fmt::format(
      "{} trials each, joint clearance {:g} mm; the most tolerant last\n"
      "{:24}  deploys from  monotone from {:<6g} 95 %             branch lost     {:g} % "
      "clearance\n",
      first.trials.size(), first.backlash_mm, "", first.from_deg, 100 * solver::kWantedShare);
  for (const NamedBacklash& named : several) {
    const solver::Backlash& backlash = named.backlash;
    const schema::ShareOfTrials share = schema::one_way_share(backlash, backlash.to_deg);
    const std::vector<double> lost = backlash.lost_deg();
    text += fmt::format("{:<24}  {:>12g}  {:>18.4g} % {:<16} {:>10} deg  {}\n", named.name,
                        backlash.own_deg, 100 * share.share,
                        fmt::format("{:.4g} to {:.4g}", 100 * share.low, 100 * share.high),
                        lost.empty() ? "?" : fmt::format("{:.3g}", solver::quantile(lost, 0.5)),
                        largest_words(backlash));
  }
  return text;
}

}  // namespace misalign::search
