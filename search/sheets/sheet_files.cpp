#include "search/sheets/sheet_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "schema/exchange/actuators_json.hpp"
#include "schema/exchange/deploy_json.hpp"
#include "schema/exchange/drawing.hpp"
#include "schema/exchange/dxf_pen.hpp"
#include "schema/exchange/fold_export.hpp"
#include "schema/exchange/mat_export.hpp"
#include "schema/exchange/plate_stl.hpp"
#include "schema/exchange/svg_pen.hpp"
#include "schema/files/features.hpp"
#include "schema/files/text_file.hpp"
#include "schema/kit/kit_drawing.hpp"
#include "search/sheets/contact_study.hpp"
#include "search/terminal/terminal.hpp"

namespace misalign::search {
namespace {

const char* ending(SheetFormat format) {
  switch (format) {
    case SheetFormat::json:
      return ".json";
    case SheetFormat::csv:
      return ".csv";
    case SheetFormat::mat:
      return ".mat";
    case SheetFormat::fold:
      return ".fold";
    case SheetFormat::svg:
      return ".svg";
    case SheetFormat::dxf:
      return ".dxf";
    case SheetFormat::stl:
      return ".stl";
    case SheetFormat::obj:
      return ".obj";
    case SheetFormat::mjcf:
      return ".xml";
    case SheetFormat::inp:
      break;
  }
  return ".inp";
}

// "-090deg", or "-090.5deg": the files of one candidate in the order of its folding.
std::string of_state(double pilot_deg) {
  const double whole_deg = std::floor(pilot_deg + 1e-9), rest_deg = pilot_deg - whole_deg;
  return fmt::format("-{:03}{}deg", static_cast<int>(whole_deg),
                     rest_deg > 1e-9 ? schema::shown_number(rest_deg).substr(1) : "");
}

std::string path_of(const SheetFilesOptions& options, const std::string& stem) {
  const auto path = std::filesystem::path(options.directory) / (stem + ending(options.format));
  std::error_code error;
  if (std::filesystem::equivalent(path, options.read_from, error)) {
    throw schema::UserError(schema::Cause::bad_request,
                            "--output " + options.directory +
                                ": the file would replace the one that is read (it has the same "
                                "name); name another directory");
  }
  return path.string();
}

}  // namespace

void make_directory(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!error) return;
  throw schema::UserError(schema::Cause::failure, path + ": cannot be made (" + error.message() +
                                                      "); choose another --output");
}

SheetFiles::SheetFiles(const SheetFolder& folder, const SheetFilesOptions& options)
    : folder_(folder), options_(options) {
  if (options.format == SheetFormat::mat) schema::need("matio");
  if (options.format == SheetFormat::dxf) schema::need("dxflib");
  if (options.format != SheetFormat::json && options.format != SheetFormat::fold) return;
  deployer_ = std::make_unique<Deployer>(folder.base(), folder.sampling(), folder.actuators(),
                                         DeployWish());
  if (!has("SUNDIALS") && options.warn) {
    options.warn("no deployment is in these files: " + schema::missing_text("SUNDIALS"));
  }
}

SheetFiles::~SheetFiles() = default;

void SheetFiles::write(const FoldedSheet& folded, const SheetLabel& label,
                       const schema::Json& origin) const {
  const schema::FoldingView view = folder_.view(folded);
  const std::string& stem = label.stem;
  switch (options_.format) {
    case SheetFormat::csv:
      return;
    case SheetFormat::json:
      return write_file(stem, data_of(folded, view, origin).dump(1) + "\n");
    case SheetFormat::mat:
      if constexpr (has("matio")) {
        write_file(stem,
                   schema::folded_mat(path_of(options_, stem), view, folded.path, folded.actuation,
                                      folded.metrics, folder_.sampling(), label.title, origin));
      }
      return;
    case SheetFormat::svg:
    case SheetFormat::dxf:
      return write_drawings(folded, label);
    case SheetFormat::fold:
      return write_file(stem, fold_text(folded, view, label, origin));
    case SheetFormat::obj:
      return write_states(folded, label);
    case SheetFormat::mjcf:
    case SheetFormat::inp:
      return write_file(stem, simulated(folded, label));
    case SheetFormat::stl:
      return write_plates(folded, label);
  }
}

std::string SheetFiles::simulated(const FoldedSheet& folded, const SheetLabel& label) const {
  const schema::SimulatedSheet sheet =
      release(folder_, folded, options_.release, label.title, label.name);
  return options_.format == SheetFormat::mjcf ? schema::mjcf_model(sheet, options_.mjcf)
                                              : schema::calculix_deck(sheet, options_.deck);
}

schema::Json SheetFiles::data_of(const FoldedSheet& folded, const schema::FoldingView& view,
                                 const schema::Json& origin) const {
  schema::Json data = schema::folded_pattern_json(
      folder_.sampling(), view, folded.metrics,
      schema::actuation_json(view, folded.path, folded.actuation), deployment_of(folded));
  data.update(origin);
  return data;
}

// Null where it cannot be let go.
schema::Json SheetFiles::deployment_of(const FoldedSheet& folded) const {
  const double deploys_from_deg =
      folded.path.history.verdict.deploys_from_sample * folder_.sampling().sample_deg;
  const auto study = deployer_->study_if_possible(folded.shifts_mm, deploys_from_deg);
  return study ? schema::exported_deployment_json(*study) : schema::Json();
}

std::string SheetFiles::fold_text(const FoldedSheet& folded, const schema::FoldingView& view,
                                  const SheetLabel& label, const schema::Json& origin) const {
  const auto rows = solver::rows_to_show(folder_.mechanism(), folded.path, options_.step_deg);
  folder_.check_shapes(folded, rows, label.name);
  schema::Json data = data_of(folded, view, origin);
  data.erase("pattern");  // is beside it
  return schema::folded_fold_json(view, folded.path, rows, label.title, data,
                                  fillers_of(folded, rows, label.name))
             .dump() +
         "\n";
}

// None unless they are asked for.
std::vector<solver::Filler> SheetFiles::fillers_of(const FoldedSheet& folded,
                                                   const std::vector<Eigen::Index>& rows,
                                                   const std::string& name) const {
  if (!options_.joined) return {};
  std::vector<const Eigen::Matrix3Xd*> shapes_mm;
  for (const Eigen::Index row : rows) {
    shapes_mm.push_back(&folded.path.shapes_mm[static_cast<std::size_t>(row)]);
  }
  auto fillers = solver::joining_fillers(folder_.base().base, folder_.mechanism(),
                                         folded.vertices_mm, shapes_mm);
  if (fillers) return std::move(*fillers);
  throw schema::UserError(
      schema::Cause::bad_request,
      "--joined: no fillers can join the panels of " + name +
          " (corners of its holes get wider on the way); take it out, and use the frames");
}

// A crease pattern, or a kit as NAME-kit, with a bed as NAME-kit-1, NAME-kit-2 and so on.
void SheetFiles::write_drawings(const FoldedSheet& folded, const SheetLabel& label) const {
  const auto text_of = [&](const schema::LineDrawing& drawing) {
    if constexpr (has("dxflib")) {
      if (options_.format == SheetFormat::dxf) return schema::dxf_of(drawing);
    }
    return schema::svg_of(drawing);
  };
  const schema::Pattern& base = folder_.base();
  if (!options_.kit) {
    return write_file(label.stem, text_of(schema::crease_pattern_drawing(
                                      base, folded.vertices_mm, folder_.mechanism(), label.title)));
  }
  const schema::KitSheet sheet{base.base, folded.vertices_mm, folded.shifts_mm, folder_.mechanism(),
                               folded.path};
  const schema::KitDrawings kit = schema::kit_drawings(sheet, *options_.kit, label.title);
  if (!kit.warning.empty() && options_.warn) options_.warn(label.name + ": " + kit.warning);
  std::vector<std::string> texts;
  for (const schema::LineDrawing& bed : kit.beds) texts.push_back(text_of(bed));
  for (std::size_t k = 0; k < texts.size(); ++k) {
    write_file(label.stem + (options_.kit->bed_mm ? fmt::format("-kit-{}", k + 1) : "-kit"),
               texts[k]);
  }
}

void SheetFiles::write_states(const FoldedSheet& folded, const SheetLabel& label) const {
  const auto rows = solver::rows_to_show(folder_.mechanism(), folded.path, options_.step_deg);
  folder_.check_shapes(folded, rows, label.name);
  Eigen::Matrix3Xd flat_mm = Eigen::Matrix3Xd::Zero(3, folded.vertices_mm.cols());
  flat_mm.topRows<2>() = folded.vertices_mm;
  const auto write_state = [&](double pilot_deg, const Eigen::Matrix3Xd& shape_mm) {
    write_file(label.stem + of_state(pilot_deg),
               schema::folded_obj(folder_.base(), shape_mm,
                                  fmt::format("{}, pilot at {:.10g} deg", label.title, pilot_deg)));
  };
  write_state(0, flat_mm);
  for (const Eigen::Index row : rows) {
    const auto k = static_cast<std::size_t>(row);
    write_state(folded.path.history.stations[k].pilot_deg, folded.path.shapes_mm[k]);
  }
}

void SheetFiles::write_plates(const FoldedSheet& folded, const SheetLabel& label) const {
  const auto rows = solver::rows_to_show(folder_.mechanism(), folded.path, options_.step_deg);
  folder_.check_shapes(folded, rows, label.name);
  ContactStudier studier(folder_.base(), folder_.sampling());
  const solver::ContactStudy study = studier.study(folded.shifts_mm, options_.trim_mm, label.name);
  const double largest_mm = study.thickness ? study.thickness->thickness_mm : 0;
  if (!(options_.release.plates.thickness_mm <= largest_mm)) {
    throw schema::UserError(
        schema::Cause::bad_request,
        fmt::format("--thickness {:g}: too thick (plates of {} reach D if they have at most {:.4g} "
                    "mm, trimmed by {:g} mm); take less, or say more by --trim",
                    options_.release.plates.thickness_mm, label.name, largest_mm, study.trim_mm));
  }
  const auto solids = solver::plate_solids(studier.panels(), folded.vertices_mm,
                                           options_.release.plates.thickness_mm, study.trim_mm,
                                           study.thickness->largest_rad);
  const auto write_state = [&](double pilot_deg, const Eigen::Matrix3Xd& shape_mm) {
    write_file(
        label.stem + of_state(pilot_deg),
        schema::plate_stl(folder_.base(), studier.panels(), folded.vertices_mm, solids, shape_mm));
  };
  Eigen::Matrix3Xd flat_mm = Eigen::Matrix3Xd::Zero(3, folded.vertices_mm.cols());
  flat_mm.topRows<2>() = folded.vertices_mm;
  write_state(0, flat_mm);
  for (const Eigen::Index row : rows) {
    const auto k = static_cast<std::size_t>(row);
    write_state(folded.path.history.stations[k].pilot_deg, folded.path.shapes_mm[k]);
  }
}

void SheetFiles::write_file(const std::string& stem, const std::string& text) const {
  const std::string path = path_of(options_, stem);
  schema::write_text_file(path, text);
  put(schema::printable(path) + "\n");
}

SheetTables::SheetTables(const SheetFolder& folder, const SheetFilesOptions& options,
                         const std::string& stem, const std::string& key)
    : folder_(folder),
      every_deg_(options.every_deg),
      key_{key, ""},
      diagonals_(path_of(options, stem)) {
  diagonals_.file.write(schema::diagonal_columns(key_));
  if (!options.creases) return;
  creases_.emplace(path_of(options, stem + "-creases"));
  creases_->file.write(schema::crease_columns(key_));
}

void SheetTables::add(const FoldedSheet& folded, const std::string& key) {
  const schema::FoldingView view = folder_.view(folded);
  key_.value = key;
  diagonals_.file.write(schema::diagonal_rows(key_, view, folded.actuation, every_deg_));
  if (creases_) creases_->file.write(schema::crease_rows(key_, view, every_deg_));
}

void SheetTables::publish() {
  diagonals_.publish();
  if (creases_) creases_->publish();
}

void SheetTables::Table::publish() {
  file.publish();
  put(schema::printable(name) + "\n");
}

}  // namespace misalign::search
