#include "search/sheets/tolerance_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/exchange/tolerance_json.hpp"

namespace misalign::search {
namespace {

std::string share_line(const solver::Tolerance& t, double deg, std::uint64_t hits) {
  const schema::ShareOfTrials share = schema::share_of(hits, t.copies);
  return fmt::format("yield from {:<6g} {}, {:.4g} % (95 %: {:.4g} to {:.4g})\n", deg, hits,
                     100 * share.share, 100 * share.low, 100 * share.high);
}

std::string vertices_text(const solver::Tolerance& t) {
  std::string text = fmt::format(
      "one vertex alone, {} copies each, the most harmful first\n"
      "vertex  yield from {:g}  mean loss, deg\n",
      t.vertices.front().copies.trials, t.threshold_deg);
  for (const solver::Tolerance::Vertex& vertex : t.vertices) {
    const std::uint64_t survivors = vertex.copies.from(t.threshold_sample);
    text += fmt::format("{:<6} {:>12.4g} % {:>15.4g}\n", solver::vertex_label(vertex.vertex),
                        100 * schema::share_of(survivors, vertex.copies).share,
                        t.mean_loss_deg(vertex.copies));
  }
  return text + "\n";
}

// The stops of copies whose springs or plates are made for the sheet itself.
std::string stops_text(const solver::Tolerance& t) {
  const solver::MiscutStops& stops = t.copies.stops;
  const bool has_friction = t.friction_n_mm_per_mm > 0;
  const std::string own_stop = !t.own_stop ? "nowhere"
                               : t.own_stop->at_deg == 0
                                   ? "flat"
                                   : fmt::format("{:.4g} deg", t.own_stop->at_deg);
  std::string text = "stops at          " + own_stop;
  if (has_friction && t.own_stop) {
    text += fmt::format(", held by friction down to {:.4g} deg", t.own_stop->held_from_deg);
  }
  text += fmt::format("; of {} copies {} stop, {} unfold flat", stops.trials(), stops.stops.size(),
                      stops.flat);
  text += stops.held > 0 ? fmt::format(", {} are held\n", stops.held) : "\n";
  if (stops.stops.empty()) return text;
  const auto line = [&](const char* what, double solver::Stop::*value, const char* unit) {
    text += fmt::format("{:<17}", what);
    const std::vector<double> values = stops.sorted(value);
    for (const double share : solver::kShownShares) {
      text +=
          fmt::format(" {:.2f} {} ({:g} %)", solver::quantile(values, share), unit, 100 * share);
    }
    text += "\n";
  };
  line("stops of copies", &solver::Stop::at_deg, "deg");
  if (has_friction) line("held, lowest", &solver::Stop::held_from_deg, "deg");
  if (t.has_shapes) {
    line("off target, rms", &solver::Stop::shape_rms_mm, "mm");
    line("off target, max", &solver::Stop::shape_max_mm, "mm");
  }
  return text;
}

}  // namespace

std::string tolerance_text(const NamedTolerance& named) {
  const solver::Tolerance& t = named.tolerance;
  std::string text = t.vertices.empty() ? "" : vertices_text(t);
  text += fmt::format("{}, deploys from {:g} deg; {} copies, cutting error up to {:g} mm\n",
                      named.name, t.own_sample * t.sample_deg, t.copies.trials, t.amplitude_mm);
  text += "deploy from      ";
  for (const double share : solver::kShownShares) {
    text += fmt::format(" {:g} deg ({:g} %)", t.copies.quantile(share) * t.sample_deg, 100 * share);
  }
  text += "\n";
  if (t.copies.undecided > 0) {
    text += fmt::format("undecided         {}: the intervals allow both\n", t.copies.undecided);
  }
  if (t.own_sample > t.threshold_sample) {
    text += share_line(t, t.own_sample * t.sample_deg, t.copies.from(t.own_sample));
  }
  text += share_line(t, t.threshold_deg, t.survivors());
  return t.copies.stops.trials() > 0 ? text + stops_text(t) : text;
}

std::string tolerances_text(std::vector<NamedTolerance> several) {
  const auto share = [](const NamedTolerance& named) {
    return schema::share_of(named.tolerance.survivors(), named.tolerance.copies);
  };
  std::stable_sort(several.begin(), several.end(),
                   [&](const auto& a, const auto& b) { return share(a).share < share(b).share; });
  const solver::Tolerance& first = several.front().tolerance;
  std::string text = fmt::format(
      "{} copies each, cutting error up to {:g} mm; the most tolerant last\n"
      "{:24}  deploys from  yield from {:<6g} 95 %\n",
      first.copies.trials, first.amplitude_mm, "", first.threshold_deg);
  for (const NamedTolerance& named : several) {
    const solver::Tolerance& t = named.tolerance;
    const schema::ShareOfTrials survive = share(named);
    text += fmt::format("{:<24}  {:>12g}  {:>15.4g} % {:.4g} to {:.4g}\n", named.name,
                        t.own_sample * t.sample_deg, 100 * survive.share, 100 * survive.low,
                        100 * survive.high);
  }
  return text;
}

std::string miscut_gap_text(const std::string& name, const solver::MiscutGap& gap) {
  const Eigen::Index worst = gap.worst_angle();
  std::string text = fmt::format(
      "{}: largest joint gaps at a cutting error up to {:g} mm, of {} copies: median {:.4f} mm,\n"
      "95 % quantile {:.4f} mm (at {:g} deg); play of that radius or bending panels close them\n\n"
      "pilot_deg  median_mm  95 %_mm  largest_mm\n",
      name, gap.amplitude_mm, gap.open_mm.rows(), gap.quantile_mm(0.5, worst),
      gap.quantile_mm(0.95, worst), gap.pilot_deg[static_cast<std::size_t>(worst)]);
  for (Eigen::Index k = 0; k < gap.open_mm.cols(); ++k) {
    text +=
        fmt::format("{:9g} {:10.4f} {:8.4f} {:11.4f}\n", gap.pilot_deg[static_cast<std::size_t>(k)],
                    gap.quantile_mm(0.5, k), gap.quantile_mm(0.95, k), gap.quantile_mm(1, k));
  }
  return text;
}

}  // namespace misalign::search
