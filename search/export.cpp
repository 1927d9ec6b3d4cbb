#include "search/export.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "schema/actuation_json.hpp"
#include "schema/catalogue_state.hpp"
#include "schema/drawing.hpp"
#include "schema/fold_export.hpp"
#include "schema/text_file.hpp"

namespace misalign::search {
namespace {

const char* ending(ExportFormat format) {
  switch (format) {
    case ExportFormat::json:
      return ".json";
    case ExportFormat::csv:
      return ".csv";
    case ExportFormat::fold:
      return ".fold";
    case ExportFormat::svg:
      return ".svg";
    default:
      return ".obj";
  }
}

// "-090deg", or "-090.5deg": the files of one candidate in the order of its folding.
std::string of_state(double pilot_deg) {
  char text[40];
  std::snprintf(text, sizeof text, "-%03d", static_cast<int>(std::floor(pilot_deg + 1e-9)));
  const double rest = pilot_deg - std::floor(pilot_deg + 1e-9);
  return text + (rest > 1e-9 ? schema::shown_number(rest).substr(1) : "") + "deg";
}

// One candidate's files.
class Exporter {
 public:
  Exporter(const SQLite::Database& database, const schema::Campaign& campaign,
           const DrawFolder& folder, const ExportOptions& options)
      : database_(database), campaign_(campaign), folder_(folder), options_(options) {}

  void write(std::uint64_t draw) const {
    const FoldedDraw folded = folder_.fold(draw);
    if (!folded.accepted) {
      throw schema::damaged(
          database_, "draw " + std::to_string(draw) + " is among the candidates, but is none");
    }
    const schema::FoldingView view = folder_.view(folded);
    const std::string stem = campaign_.name + "-" + std::to_string(draw);
    const std::string title = "misalign: " + campaign_.name + ", draw " + std::to_string(draw);
    switch (options_.format) {
      case ExportFormat::csv:
        return write(stem, schema::folding_csv(view, folded.actuation));
      case ExportFormat::json:
        return write(stem, candidate(folded, view).dump(1) + "\n");
      case ExportFormat::svg:
        return write(stem, schema::crease_pattern_svg(campaign_.pattern, folded.vertices_mm,
                                                      folder_.mechanism(), title));
      case ExportFormat::fold:
        return write(stem, fold_text(folded, view, title));
      case ExportFormat::obj:
        return write_states(folded, stem, title);
    }
  }

 private:
  schema::Json candidate(const FoldedDraw& folded, const schema::FoldingView& view) const {
    return schema::candidate_json(campaign_, folded.draw, view, *folded.metrics,
                                  schema::actuation_json(view, folded.path, folded.actuation));
  }

  std::string fold_text(const FoldedDraw& folded, const schema::FoldingView& view,
                        const std::string& title) const {
    const auto rows = schema::rows_to_show(folded.path, options_.step_deg);
    folder_.check_shapes(folded, rows);
    schema::Json data = candidate(folded, view);
    data.erase("pattern");  // is beside it
    return schema::folded_fold_json(view, folded.path, rows, title, data).dump() + "\n";
  }

  void write_states(const FoldedDraw& folded, const std::string& stem,
                    const std::string& title) const {
    const auto rows = schema::rows_to_show(folded.path, options_.step_deg);
    folder_.check_shapes(folded, rows);
    Eigen::Matrix3Xd flat_mm = Eigen::Matrix3Xd::Zero(3, folded.vertices_mm.cols());
    flat_mm.topRows<2>() = folded.vertices_mm;
    const auto write_state = [&](double pilot_deg, const Eigen::Matrix3Xd& shape_mm) {
      write(stem + of_state(pilot_deg),
            schema::folded_obj(campaign_.pattern, shape_mm,
                               title + ", pilot at " + schema::shown_number(pilot_deg) + " deg"));
    };
    write_state(0, flat_mm);
    for (const Eigen::Index row : rows) {
      const auto k = static_cast<std::size_t>(row);
      write_state(folded.path.history.stops[k].pilot_deg, folded.path.shapes_mm[k]);
    }
  }

  void write(const std::string& stem, const std::string& text) const {
    const auto path = std::filesystem::path(options_.output) / (stem + ending(options_.format));
    schema::write_text_file(path.string(), text);
    std::puts(path.c_str());
  }

  const SQLite::Database& database_;
  const schema::Campaign& campaign_;
  const DrawFolder& folder_;
  const ExportOptions& options_;
};

}  // namespace

void export_candidates(const ExportOptions& options) {
  const auto database = schema::open_for_reading(options.catalogue_path);
  const std::vector<std::uint64_t> draws = chosen_draws(*database, options.choice);
  schema::Campaign campaign = schema::read_campaign_of(*database, options.catalogue_path);
  campaign.actuators = options.actuators.instead_of(campaign.actuators);
  const bool in_states =
      options.format == ExportFormat::fold || options.format == ExportFormat::obj;
  const DrawFolder folder(campaign, in_states ? options.step_deg : 0);
  std::error_code error;
  std::filesystem::create_directories(options.output, error);
  if (error) {
    throw schema::UserError(
        schema::kExitFailure,
        options.output + ": cannot be made (" + error.message() + "); choose another --output");
  }
  const Exporter exporter(*database, campaign, folder, options);
  for (const std::uint64_t draw : draws) exporter.write(draw);
}

}  // namespace misalign::search
