#include "search/sheets/folding_text.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "schema/files/text_table.hpp"
#include "schema/pattern/fill_words.hpp"
#include "schema/pattern/judging_fill.hpp"
#include "schema/pattern/perforation_check.hpp"
#include "search/sheets/springs_at_vertices.hpp"
#include "search/sheets/target_text.hpp"
#include "search/terminal/screen.hpp"
#include "solver/sheet/energy_history.hpp"

namespace misalign::search {
namespace {

using schema::Json;
using schema::shown_number;

// Names diagonals whose strokes up to D are below the cutting error; empty where none is.
std::string shortest_strokes(const schema::FoldingView& view, double miscut_mm) {
  const double d_deg = view.history.verdict.deploys_from_sample * view.sample_deg;
  if (d_deg <= 0) return "";
  const auto rows = std::ranges::count_if(view.history.stations, [&](const auto& station) {
    return station.pilot_deg <= d_deg + 1e-9;
  });
  const std::vector<double> strokes_mm = solver::strokes_mm(view.history, rows);
  const auto least = std::ranges::min_element(strokes_mm);
  if (*least >= miscut_mm) return "";
  const auto shorter =
      std::ranges::count_if(strokes_mm, [&](double stroke_mm) { return stroke_mm < miscut_mm; });
  const solver::Diagonal& diagonal =
      view.mechanism.diagonals[static_cast<std::size_t>(least - strokes_mm.begin())];
  return fmt::format("\nstrokes of {} of {} diagonals are below {:g} mm: {} has {:.3g} mm", shorter,
                     strokes_mm.size(), miscut_mm, solver::line_label(diagonal.from, diagonal.to),
                     *least);
}

// D of the filling's energy beside that of the diagonals; empty without such a filling.
std::string energy_words(const schema::FoldingView& view, const std::optional<solver::Fill>& fill) {
  if (!fill || !schema::drives_to_flat(*fill)) return "";
  const solver::EnergyHistory found = solver::energy_history(view.sheet, view.history, *fill);
  const double d_deg = found.deploys_from_sample * view.sample_deg;
  std::string text = fmt::format("\nenergy of {} falls to flat from {:g} deg",
                                 schema::fill_words(*fill, view.mechanism.diagonal_count()), d_deg);
  if (!found.rises_to_the_end) {
    text += fmt::format("\nit rises again from {:g} deg", d_deg + view.sample_deg);
    if (found.where >= 0) {
      const solver::Diagonal& diagonal =
          view.mechanism.diagonals[static_cast<std::size_t>(found.where)];
      text += ", most by " + solver::line_label(diagonal.from, diagonal.to);
    }
  }
  if (found.monotone_to_sample == view.history.verdict.deploys_from_sample) return text;
  return text + fmt::format("\nall diagonals are monotone from {:g} deg",
                            found.monotone_to_sample * view.sample_deg);
}

// Verdict and limits in words.
std::string summary(const schema::FoldingView& view, const FoldingTextOptions& options) {
  const solver::Verdict& verdict = view.history.verdict;
  const double d_deg = verdict.deploys_from_sample * view.sample_deg;
  std::string text = options.paint.bold(fmt::format("deploys from {:g} deg", d_deg)) +
                     "; first fault: " + solver::fault_name(verdict.first_fault);
  if (const int sample = verdict.fault_sample(); sample > 0) {
    text += fmt::format(" at {:g} deg", sample * view.sample_deg);
  }
  const std::string where = schema::where_label(view.mechanism, verdict);
  if (!where.empty()) text += ", " + where;
  if (verdict.first_fault == solver::Fault::undecided) {
    text += std::string(", ") + schema::undecided_cause(verdict);
  }
  if (const solver::Between& between = view.history.between; between.bump_where >= 0) {
    const solver::Diagonal& diagonal = view.mechanism.diagonals[between.bump_where];
    text += fmt::format("\nbump between samples from {:.4f} deg, {}", between.bump_deg,
                        solver::line_label(diagonal.from, diagonal.to));
  }
  if (const solver::SpringEnds& springs = view.mechanism.springs; !springs.at_vertices()) {
    text += "\nsprings end " + where_springs_end(springs);
  }
  text += energy_words(view, options.fill);
  if (options.fill) text += target_text(view, *options.fill);
  text += shortest_strokes(view, options.miscut_mm);
  const double end_deg = view.history.path.fold_limit_deg;
  if (end_deg < 180 && end_deg + view.sample_deg >= 180 &&
      schema::closes_at_180(view.base.base, view.shifts_mm)) {
    text +=
        "\njudged up to the sample before 180 deg, where all creases close at once and rounding "
        "would decide";
  }
  const bool limit = view.history.path.end == solver::PathEnd::fold_limit;
  return fmt::format("{}\n{} {:.4f} deg; {} unknowns, {} equations\n", text,
                     limit ? "fold limit" : "followed to", view.history.path.fold_limit_deg,
                     view.mechanism.unknowns, view.mechanism.equations);
}

// One diagonal's lengths over the path, flat first.
struct DiagonalPath {
  std::vector<double> pilot_deg, length_mm;

  double at(double deg) const {
    const auto above = std::lower_bound(pilot_deg.begin(), pilot_deg.end(), deg);
    if (above == pilot_deg.end()) return length_mm.back();
    const auto k = static_cast<std::size_t>(above - pilot_deg.begin());
    if (k == 0) return length_mm.front();
    const double share = (deg - pilot_deg[k - 1]) / (pilot_deg[k] - pilot_deg[k - 1]);
    return length_mm[k - 1] + share * (length_mm[k] - length_mm[k - 1]);
  }
};

DiagonalPath path_of(const solver::FoldingHistory& history, std::size_t diagonal) {
  DiagonalPath path{{0}, {history.flat_mm[diagonal]}};
  for (std::size_t row = 0; row < history.stations.size(); ++row) {
    path.pilot_deg.push_back(history.stations[row].pilot_deg);
    path.length_mm.push_back(
        history.length_mm(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(diagonal)));
  }
  return path;
}

// Least and largest change of a diagonal's length up to `to_deg`, of its flat length; flat is 0.
struct Changes {
  double least = 0, most = 0;
};

Changes changes_up_to(double to_deg, const DiagonalPath& path) {
  Changes changes;
  const double flat_mm = path.length_mm.front();
  for (std::size_t row = 0; row < path.pilot_deg.size(); ++row) {
    if (path.pilot_deg[row] > to_deg + 1e-9) break;
    const double change = (path.length_mm[row] - flat_mm) / flat_mm;
    changes.least = std::min(changes.least, change);
    changes.most = std::max(changes.most, change);
  }
  return changes;
}

// Variations below the verdict's band are rounding, and shown as the flat length.
void still_if_inactive(DiagonalPath& path, double panel_width_mm) {
  const auto [least, most] = std::minmax_element(path.length_mm.begin(), path.length_mm.end());
  if (*most - *least >= solver::kInactiveBand_widths * panel_width_mm) return;
  std::fill(path.length_mm.begin(), path.length_mm.end(), path.length_mm.front());
}

// The angles of a sparkline's columns.
struct Scale {
  double end_deg, d_deg;
  std::size_t columns;

  double deg_of(std::size_t column) const {
    return end_deg * static_cast<double>(column) / static_cast<double>(columns - 1);
  }
  /// Columns that lie at or below D; all of them if D is the end.
  std::size_t columns_to_d() const {
    std::size_t count = 0;
    while (count < columns && deg_of(count) <= d_deg + 1e-9) ++count;
    return count;
  }
};

// "0 ... 112|    156": the path's ends, and D at the sparklines' bar.
std::string scale_text(const Scale& scale) {
  const std::string end = fmt::format("{:.4g}", scale.end_deg),
                    d = fmt::format("{:g}|", scale.d_deg);
  std::string text(scale.columns + 1, ' ');
  text.replace(0, 1, "0");
  const std::size_t to_d = scale.columns_to_d();
  // The bar of a D close to the end replaces the end's number.
  if (to_d == scale.columns || to_d + 1 < text.size() - end.size()) {
    text.replace(text.size() - end.size(), end.size(), end);
  }
  if (to_d == scale.columns) return text.substr(1).replace(0, 1, "0");
  if (scale.d_deg > 0) text[to_d] = '|';
  if (scale.d_deg > 0 && to_d >= d.size() + 1 && to_d + end.size() + 2 < text.size()) {
    text.replace(to_d + 1 - d.size(), d.size(), d);
  }
  return text;
}

std::string direction(double change_mm) {
  return change_mm > 0 ? "increasing" : change_mm < 0 ? "decreasing" : "still";
}

std::string sparklines(const schema::FoldingView& view, const FoldingTextOptions& options) {
  const solver::FoldingHistory& history = view.history;
  const double end_deg = history.stations.empty() ? 0 : history.stations.back().pilot_deg;
  if (end_deg <= 0) return "";
  const double d_deg = history.verdict.deploys_from_sample * view.sample_deg;
  // Lengths are shown up to D, of a sheet that does not deploy up to the end.
  const double to_deg = d_deg > 0 ? std::min(d_deg, end_deg) : end_deg;
  const std::string to = shown_number(to_deg);
  std::vector<schema::Row> rows = {
      {"diagonal", "hole", "flat_mm", "at " + to, "up to " + to, "elongation %", ""}};
  std::vector<DiagonalPath> paths;
  for (std::size_t k = 0; k < view.mechanism.diagonals.size(); ++k) {
    const solver::Diagonal& diagonal = view.mechanism.diagonals[k];
    paths.push_back(path_of(history, k));
    still_if_inactive(paths.back(), view.mechanism.panel_width_mm);
    const DiagonalPath& path = paths.back();
    const double flat_mm = history.flat_mm[k], at_mm = path.at(to_deg);
    const Changes changes = changes_up_to(to_deg, path);
    const Json facet = schema::diagonal_json(view.base, view.mechanism, diagonal, flat_mm)["hole"];
    rows.push_back({solver::line_label(diagonal.from, diagonal.to),
                    facet.is_array() ? facet.dump() : "face " + facet.dump(),
                    fmt::format("{:.3f}", flat_mm), fmt::format("{:.3f}", at_mm),
                    direction(at_mm - flat_mm),
                    fmt::format("{:+.2f} {:+.2f}", 100 * changes.least, 100 * changes.most)});
  }
  const std::vector<bool> numeric = {false, false, true, true, false, true, false};
  std::string table = schema::aligned(rows, numeric);
  std::size_t used = 0;
  for (std::size_t begin = 0, stop; (stop = table.find('\n', begin)) != std::string::npos;
       begin = stop + 1) {
    used = std::max(used, stop - begin);
  }
  constexpr std::size_t kLeast = 12, kMost = 60;
  const std::size_t room = static_cast<std::size_t>(std::max(options.width, 0));
  const std::size_t columns =
      std::clamp(room > used + 3 ? room - used - 3 : 0, kLeast, kMost);  // two blanks and the bar
  const Scale scale{end_deg, to_deg, columns};
  rows[0][6] = scale_text(scale);
  const std::size_t to_d = scale.columns_to_d();
  for (std::size_t k = 0; k < paths.size(); ++k) {
    std::vector<double> values;
    for (std::size_t column = 0; column < columns; ++column) {
      values.push_back(paths[k].at(scale.deg_of(column)));
    }
    std::string line = sparkline(values, options.utf8);
    if (to_d < columns) {
      const std::size_t bytes = options.utf8 ? 3 * to_d : to_d;
      line.insert(bytes, "|");
    }
    rows[k + 1].push_back(line);
  }
  table = schema::aligned(rows, numeric);
  const std::size_t header = table.find('\n');
  return options.paint.bold(table.substr(0, header)) + table.substr(header);
}

// Lengths every 10 degrees and at D, and always those that --step added.
std::string lengths(const schema::FoldingView& view) {
  const solver::FoldingHistory& history = view.history;
  std::string text = "pilot_deg";
  for (const solver::Diagonal& diagonal : view.mechanism.diagonals) {
    text += fmt::format(" {:>9}", solver::line_label(diagonal.from, diagonal.to));
  }
  text += "\n        0";
  for (const double flat : history.flat_mm) text += fmt::format(" {:>9.4f}", flat);
  text += "\n";
  for (std::size_t row = 0; row < history.stations.size(); ++row) {
    const solver::Station& station = history.stations[row];
    const bool at_d = station.sample > 0 && station.sample == history.verdict.deploys_from_sample;
    const bool round = std::abs(std::remainder(station.pilot_deg, 10)) < 1e-9;
    if (!round && !at_d && station.sample > 0) continue;
    text += fmt::format("{:>9g}", station.pilot_deg);
    for (Eigen::Index d = 0; d < history.length_mm.cols(); ++d) {
      text += fmt::format(" {:>9.4f}", history.length_mm(static_cast<Eigen::Index>(row), d));
    }
    text += at_d ? " <- D\n" : "\n";
  }
  return text;
}

}  // namespace

std::string sparkline(const std::vector<double>& values, bool utf8) {
  constexpr std::array<const char*, 8> kBlocks = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  constexpr std::array<const char*, 8> kSigns = {"_", ".", ":", "-", "=", "+", "*", "#"};
  std::string line;
  if (values.empty()) return line;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  for (const double value : values) {
    const double share = *most > *least ? (value - *least) / (*most - *least) : 0;
    const auto height = std::min<std::size_t>(static_cast<std::size_t>(share * 8), 7);
    line += (utf8 ? kBlocks : kSigns)[height];
  }
  return line;
}

std::string folding_text(const schema::FoldingView& view, const FoldingTextOptions& options) {
  constexpr int kColumn = 10, kRest = 9 + 6;  // the angle, and the mark at D
  const bool fits = kRest + kColumn * view.mechanism.diagonal_count() <= options.width;
  std::string text = summary(view, options);
  const std::string drawn = sparklines(view, options);
  if (!drawn.empty()) text += "\n" + drawn;
  if (options.table || fits) text += "\n" + lengths(view);
  return text;
}

solver::Fill fill_shown(const schema::Sampling& sampling, const schema::Design& design,
                        const schema::Pattern& pattern) {
  return sampling.energy_of ? *sampling.energy_of : design.fill(pattern.base);
}

void put_folding(const schema::FoldingView& view, const schema::Design& design,
                 const solver::Fill& fill, bool table) {
  put(folding_text(
      view, {terminal_width(STDOUT_FILENO), locale_is_utf8(), table, paint_for(STDOUT_FILENO),
             design.miscut_mm.value_or(solver::kLeastStroke_mm), fill}));
}

}  // namespace misalign::search
