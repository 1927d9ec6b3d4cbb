#include "search/verbs/export.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/yield.hpp"
#include "schema/exchange/actuation_json.hpp"
#include "schema/exchange/drawing.hpp"
#include "schema/exchange/fold_export.hpp"
#include "schema/exchange/history_table.hpp"
#include "schema/files/output_file.hpp"
#include "schema/files/text_file.hpp"
#include "search/checks/chosen_sheet.hpp"
#include "search/draws/draw.hpp"
#include "search/terminal/terminal.hpp"

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

// UserError (2) if that is the file which is read.
std::string path_of(const ExportOptions& options, const std::string& stem) {
  const auto path = std::filesystem::path(options.output) / (stem + ending(options.format));
  std::error_code error;
  if (std::filesystem::equivalent(path, options.path, error)) {
    throw schema::UserError(schema::kExitUsage,
                            "--output " + options.output +
                                ": the file would replace the one that is read (it has the same "
                                "name); name another directory");
  }
  return path.string();
}

// What a sheet's files say of whose they are.
struct Label {
  std::string stem;   // of their names
  std::string title;  // in them
  std::string name;   // in sentences
};

// One sheet's files.
class Exporter {
 public:
  Exporter(const SheetFolder& folder, const ExportOptions& options)
      : folder_(folder), options_(options) {}

  // Not for csv. `origin`: the keys of the campaign that drew it, if there is one.
  void write(const FoldedSheet& folded, const Label& label, const schema::Json& origin) const {
    const schema::FoldingView view = folder_.view(folded);
    const std::string& stem = label.stem;
    switch (options_.format) {
      case ExportFormat::csv:
        return;
      case ExportFormat::json:
        return write(stem, data_of(folded, view, origin).dump(1) + "\n");
      case ExportFormat::svg:
        return write(stem, schema::crease_pattern_svg(folder_.base(), folded.vertices_mm,
                                                      folder_.mechanism(), label.title));
      case ExportFormat::fold:
        return write(stem, fold_text(folded, view, label, origin));
      case ExportFormat::obj:
        return write_states(folded, view, label);
    }
  }

 private:
  schema::Json data_of(const FoldedSheet& folded, const schema::FoldingView& view,
                       const schema::Json& origin) const {
    schema::Json data =
        schema::folded_pattern_json(folder_.sampling(), view, folded.metrics,
                                    schema::actuation_json(view, folded.path, folded.actuation));
    data.update(origin);
    return data;
  }

  std::string fold_text(const FoldedSheet& folded, const schema::FoldingView& view,
                        const Label& label, const schema::Json& origin) const {
    const auto rows = schema::rows_to_show(view, folded.path, options_.step_deg);
    folder_.check_shapes(folded, rows, label.name);
    schema::Json data = data_of(folded, view, origin);
    data.erase("pattern");  // is beside it
    return schema::folded_fold_json(view, folded.path, rows, label.title, data).dump() + "\n";
  }

  void write_states(const FoldedSheet& folded, const schema::FoldingView& view,
                    const Label& label) const {
    const auto rows = schema::rows_to_show(view, folded.path, options_.step_deg);
    folder_.check_shapes(folded, rows, label.name);
    Eigen::Matrix3Xd flat_mm = Eigen::Matrix3Xd::Zero(3, folded.vertices_mm.cols());
    flat_mm.topRows<2>() = folded.vertices_mm;
    const auto write_state = [&](double pilot_deg, const Eigen::Matrix3Xd& shape_mm) {
      write(label.stem + of_state(pilot_deg),
            schema::folded_obj(
                folder_.base(), shape_mm,
                label.title + ", pilot at " + schema::shown_number(pilot_deg) + " deg"));
    };
    write_state(0, flat_mm);
    for (const Eigen::Index row : rows) {
      const auto k = static_cast<std::size_t>(row);
      write_state(folded.path.history.stops[k].pilot_deg, folded.path.shapes_mm[k]);
    }
  }

  void write(const std::string& stem, const std::string& text) const {
    const std::string path = path_of(options_, stem);
    schema::write_text_file(path, text);
    put(schema::printable(path) + "\n");
  }

  const SheetFolder& folder_;
  const ExportOptions& options_;
};

// All sheets as one long table, and as another one of creases if that is asked for. A sheet's rows
// are written as soon as they are known: any number of sheets takes the room of one.
class Tables {
 public:
  Tables(const SheetFolder& folder, const ExportOptions& options, const std::string& stem,
         const std::string& key)
      : folder_(folder), key_{key, ""}, diagonals_(path_of(options, stem)) {
    diagonals_.file.write(schema::diagonal_columns(key_));
    if (!options.creases) return;
    creases_.emplace(path_of(options, stem + "-creases"));
    creases_->file.write(schema::crease_columns(key_));
  }

  void add(const FoldedSheet& folded, const std::string& key) {
    const schema::FoldingView view = folder_.view(folded);
    key_.value = key;
    diagonals_.file.write(schema::diagonal_rows(key_, view, folded.actuation));
    if (creases_) creases_->file.write(schema::crease_rows(key_, view));
  }

  void publish() {
    diagonals_.publish();
    if (creases_) creases_->publish();
  }

 private:
  struct Table {
    explicit Table(const std::string& path) : name(path), file(schema::OutputFile::text(path)) {}
    void publish() {
      file.publish();
      put(schema::printable(name) + "\n");
    }
    const std::string name;
    schema::OutputFile file;
  };

  const SheetFolder& folder_;
  schema::RowKey key_;
  Table diagonals_;
  std::optional<Table> creases_;
};

void make_directory(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!error) return;
  throw schema::UserError(schema::kExitFailure, path + ": cannot be made (" + error.message() +
                                                    "); choose another --output");
}

double look_deg(const ExportOptions& options) {
  const bool in_states =
      options.format == ExportFormat::fold || options.format == ExportFormat::obj;
  return in_states ? options.step_deg : 0;
}

}  // namespace

void export_candidates(const ExportOptions& options) {
  const auto database = schema::open_for_reading(options.path);
  const std::vector<std::uint64_t> draws = chosen_draws(*database, options.choice);
  schema::Campaign campaign = schema::read_campaign_of(*database, options.path);
  campaign.actuators = options.actuators.instead_of(campaign.actuators);
  const SheetFolder folder(campaign, look_deg(options));
  make_directory(options.output);
  const auto stem_of = [&](std::uint64_t draw) {
    return campaign.name + "-" + std::to_string(draw);
  };
  const Exporter exporter(folder, options);
  std::optional<Tables> tables;
  if (options.format == ExportFormat::csv) {
    const std::vector<std::uint64_t>& named = options.choice.draws;
    tables.emplace(folder, options, named.size() == 1 ? stem_of(named[0]) : campaign.name, "draw");
  }
  for (const std::uint64_t draw : draws) {
    const std::string number = std::to_string(draw);
    const FoldedSheet folded = folder.fold(shifts_of_draw(campaign, draw));
    if (!campaign.accepts(folded.path.history.verdict)) {
      throw schema::damaged(*database, "draw " + number + " is among the candidates, but is none");
    }
    if (tables) {
      tables->add(folded, number);
      continue;
    }
    const schema::Json yields = schema::yields_json(schema::read_yields(*database, draw));
    exporter.write(
        folded,
        {stem_of(draw), "misalign: " + campaign.name + ", draw " + number, "draw " + number},
        schema::origin_json(campaign, draw, yields));
  }
  if (tables) tables->publish();
}

void export_pattern(const ExportOptions& options) {
  const ChosenSheet sheet = sheet_of_pattern_file(options.path);
  const SheetFolder folder(sheet.base, sheet.sampling,
                           options.actuators.instead_of(sheet.actuators), look_deg(options));
  make_directory(options.output);
  const FoldedSheet folded = folder.fold(sheet.shifts_mm);
  const std::string stem = std::filesystem::path(options.path).stem().string();
  if (options.format == ExportFormat::csv) {
    Tables tables(folder, options, stem, "pattern");
    tables.add(folded, sheet.pattern);
    tables.publish();
    return;
  }
  Exporter(folder, options)
      .write(folded, {stem, "misalign: " + sheet.pattern, sheet.pattern}, schema::Json::object());
}

}  // namespace misalign::search
