#include "search/sheets/export_files.hpp"

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
#include "schema/files/output_file.hpp"
#include "schema/kit/kit_drawing.hpp"
#include "schema/kit/kit_guide.hpp"
#include "schema/kit/plate_drawing.hpp"
#include "schema/kit/strip_drawing.hpp"
#include "schema/kit/test_piece.hpp"
#include "schema/pattern/design_json.hpp"
#include "schema/print/printed_kit.hpp"
#include "schema/print/solid_files.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/plate_contact.hpp"
#include "search/sheets/studies.hpp"
#include "search/terminal/terminal.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::search {
namespace {

const char* ending(ExportFormat format) {
  switch (format) {
    case ExportFormat::json:
      return ".json";
    case ExportFormat::csv:
      return ".csv";
    case ExportFormat::mat:
      return ".mat";
    case ExportFormat::fold:
      return ".fold";
    case ExportFormat::svg:
      return ".svg";
    case ExportFormat::dxf:
      return ".dxf";
    case ExportFormat::stl:
      return ".stl";
    case ExportFormat::three_mf:
      return ".3mf";
    case ExportFormat::obj:
      return ".obj";
    case ExportFormat::mjcf:
      return ".xml";
    case ExportFormat::inp:
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

std::string path_of_name(const ExportOptions& options, const std::string& name) {
  const auto path = std::filesystem::path(options.directory) / name;
  std::error_code error;
  if (std::filesystem::equivalent(path, options.read_from, error)) {
    throw schema::UserError(
        solver::OptionFault{"output", options.directory,
                            "the file would replace the one that is read (it has the same name)",
                            "name another directory"});
  }
  return path.string();
}
std::string path_of(const ExportOptions& options, const std::string& stem) {
  return path_of_name(options, stem + ending(options.format));
}

// Calls `write_state` with the pilot angle and shape of flat, then of each row.
void each_state(const solver::Sheet& sheet, const std::vector<Eigen::Index>& rows,
                const std::function<void(double, const Eigen::Matrix3Xd&)>& write_state) {
  Eigen::Matrix3Xd flat_mm = Eigen::Matrix3Xd::Zero(3, sheet.vertices_mm().cols());
  flat_mm.topRows<2>() = sheet.vertices_mm();
  write_state(0, flat_mm);
  for (const Eigen::Index row : rows) {
    const auto k = static_cast<std::size_t>(row);
    write_state(sheet.history().stations[k].pilot_deg, sheet.shapes_mm()[k]);
  }
}

}  // namespace

void make_directory(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!error) return;
  throw schema::UserError(schema::Cause::failure, path + ": cannot be made (" + error.message() +
                                                      "); choose another --output");
}

ExportFiles::ExportFiles(const FoldingModel& model, const ExportOptions& options)
    : model_(model), options_(options) {
  if (options.format == ExportFormat::mat) schema::need("matio");
  if (options.format == ExportFormat::dxf) schema::need("dxflib");
  const bool with_deployment =
      options.format == ExportFormat::json || options.format == ExportFormat::fold;
  if (with_deployment && !has("SUNDIALS") && options.warn) {
    options.warn("no deployment is in these files: " + schema::missing_text("SUNDIALS"));
  }
  if (options.look_deg() > 0) {
    at_samples_.emplace(model.base(), model.sampling(), model.design());
  }
}

// The sheet with samples alone, for studies: they do not depend on the states that are written.
const solver::Sheet& ExportFiles::at_samples(const solver::Sheet& sheet,
                                             std::optional<solver::Sheet>& another) {
  if (!at_samples_) return sheet;
  return another.emplace(at_samples_->sheet(sheet.shifts_mm(), sheet.name()));
}

void ExportFiles::write(const solver::Sheet& sheet, const ExportLabel& label,
                        const schema::Json& origin) {
  const std::string& stem = label.stem;
  switch (options_.format) {
    case ExportFormat::csv:
      return;
    case ExportFormat::json:
      return write_file(stem, data_of(sheet, origin).dump(1) + "\n");
    case ExportFormat::mat:
      if constexpr (has("matio")) {
        write_file(stem, schema::folded_mat(path_of(options_, stem), {model_.base(), sheet},
                                            actuated(sheet, model_.design()), model_.sampling(),
                                            label.title, origin));
      }
      return;
    case ExportFormat::svg:
    case ExportFormat::dxf:
      return write_drawings(sheet, label);
    case ExportFormat::fold:
      return write_file(stem, fold_text(sheet, label, origin));
    case ExportFormat::obj:
      return write_states(sheet, label);
    case ExportFormat::mjcf:
    case ExportFormat::inp:
      return write_file(stem, simulated(sheet, label));
    case ExportFormat::stl:
      return options_.kit ? write_print(sheet, label) : write_plates(sheet, label);
    case ExportFormat::three_mf:
      return write_print(sheet, label);
  }
}

std::string ExportFiles::simulated(const solver::Sheet& sheet, const ExportLabel& label) const {
  const schema::SimulatedSheet released = release(model_, sheet, options_.release, label.title);
  if (options_.format == ExportFormat::inp) return schema::calculix_deck(released, options_.deck);
  schema::MjcfOptions mjcf;
  mjcf.friction_n_mm_per_mm = hinge_friction_n_mm_per_mm(model_.design(), sheet);
  return schema::mjcf_model(released, mjcf);
}

// The deployment is null where there is none.
schema::Json ExportFiles::data_of(const solver::Sheet& sheet, const schema::Json& origin) {
  const schema::FoldingView view(model_.base(), sheet);
  std::optional<solver::Sheet> another;
  const solver::Sheet& alone = at_samples(sheet, another);
  const auto deployment = solver::deploy(alone, deploy_options(model_.design(), alone));
  schema::Json data = schema::folded_pattern_json(
      model_.sampling(), view, schema::actuation_json(view, actuated(sheet, model_.design())),
      deployment ? schema::exported_deployment_json(*deployment) : schema::Json());
  const schema::Json design = schema::explicit_design_json(model_.design());
  if (!design.empty()) data["design"] = design;
  data.update(origin);
  return data;
}

std::string ExportFiles::fold_text(const solver::Sheet& sheet, const ExportLabel& label,
                                   const schema::Json& origin) {
  const auto rows = sheet.rows_to_show(options_.step_deg);
  check_shapes(sheet, rows);
  schema::Json data = data_of(sheet, origin);
  data.erase("pattern");  // is beside it
  return schema::folded_fold_json({model_.base(), sheet}, rows, label.title, data,
                                  fillers_of(sheet, rows))
             .dump() +
         "\n";
}

std::vector<solver::Filler> ExportFiles::fillers_of(const solver::Sheet& sheet,
                                                    const std::vector<Eigen::Index>& rows) const {
  if (!options_.joined) return {};
  std::vector<const Eigen::Matrix3Xd*> shapes_mm;
  for (const Eigen::Index row : rows) {
    shapes_mm.push_back(&sheet.shapes_mm()[static_cast<std::size_t>(row)]);
  }
  auto fillers = solver::joining_fillers(model_.base().base, sheet.mechanism(), sheet.vertices_mm(),
                                         shapes_mm);
  if (fillers) return std::move(*fillers);
  throw schema::UserError(
      schema::Cause::bad_request,
      schema::parameter("joined") + ": no fillers can join the panels of " + sheet.name() +
          " (corners of its holes get wider on the way); take it out, and use the frames");
}

// Writes a crease pattern, or the drawings of a kit: NAME-kit, with a bed NAME-kit-1 and so on.
void ExportFiles::write_drawings(const solver::Sheet& sheet, const ExportLabel& label) {
  const auto text_of = [&](schema::LineDrawing drawing) {
    if (options_.only_cut) drawing.keep_cuts();
    if constexpr (has("dxflib")) {
      if (options_.format == ExportFormat::dxf) return schema::dxf_of(drawing);
    }
    return schema::svg_of(drawing);
  };
  if (!options_.kit) {
    return write_file(label.stem, text_of(schema::crease_pattern_drawing(
                                      model_.base(), sheet.vertices_mm(), sheet.mechanism(),
                                      label.title, model_.design().diagonals_name())));
  }
  const schema::KitOptions options = kit_of(sheet);
  const schema::Kit kit = schema::kit_of(sheet, options, label.title);
  if (!kit.warning.empty() && options_.warn) options_.warn(sheet.name() + ": " + kit.warning);
  std::vector<std::pair<const char*, schema::KitSheets>> drawn = {
      {"-kit", kit.sheets},
      {"-kit-strips", schema::kit_strip_sheets(sheet, kit.fittings, options, label.title)},
      {"-kit-spacers", schema::kit_spacer_sheets(sheet, kit, options, label.title)}};
  const solver::Fill fill = model_.design().fill(model_.base().base);
  if (const auto* plates = std::get_if<solver::RubberPlates>(&fill)) {
    auto sheets = schema::kit_plate_sheets(sheet, *plates, options, label.title);
    drawn.emplace_back("-kit-plates", std::move(sheets));
  }
  const std::string guide = guide_of(sheet, label, options, kit);
  for (const auto& [ending, sheets] : drawn) {
    for (std::size_t k = 0; k < sheets.beds.size(); ++k) {
      const std::string bed = options.bed_mm ? fmt::format("-{}", k + 1) : "";
      write_file(label.stem + ending + bed, text_of(sheets.beds[k]));
    }
  }
  if (options.test_piece) {
    write_file(label.stem + "-kit-test",
               text_of(schema::kit_test_piece(options, kit.fittings.edges, label.title)));
  }
  write_named(label.stem + "-kit.html", guide);
}

std::string ExportFiles::guide_of(const solver::Sheet& sheet, const ExportLabel& label,
                                  const schema::KitOptions& options, const schema::Kit& kit) const {
  schema::Design used = model_.design();
  used.from_deg = options.from_deg;
  const solver::Actuation actuation = actuated(sheet, used);
  std::optional<solver::ContactStudy> contact;
  if (actuation.from_row > 0) {
    const std::optional<double> trim_mm = options.plates ? options_.trim_mm : std::nullopt;
    contact = known_contact(sheet, {trim_mm, options.from_deg});
  }
  return schema::kit_guide({sheet, options, kit, model_.design(), actuation,
                            contact ? &*contact : nullptr, label.title});
}

void ExportFiles::write_states(const solver::Sheet& sheet, const ExportLabel& label) const {
  const auto rows = sheet.rows_to_show(options_.step_deg);
  check_shapes(sheet, rows);
  each_state(sheet, rows, [&](double pilot_deg, const Eigen::Matrix3Xd& shape_mm) {
    write_file(label.stem + of_state(pilot_deg),
               schema::folded_obj(model_.base(), shape_mm,
                                  fmt::format("{}, pilot at {:.10g} deg", label.title, pilot_deg)));
  });
}

void ExportFiles::write_plates(const solver::Sheet& sheet, const ExportLabel& label) {
  const auto rows = sheet.rows_to_show(options_.step_deg);
  check_shapes(sheet, rows);
  const double thickness_mm = options_.release.plates.thickness_mm;
  std::optional<solver::Sheet> another;
  const solver::ContactStudy study = contact_of_plates(
      at_samples(sheet, another), {options_.trim_mm, options_.release.from_deg}, thickness_mm);
  const auto solids = solver::plate_solids(sheet.panels(), sheet.vertices_mm(), thickness_mm,
                                           study.trim_mm, study.thickness->largest_rad);
  each_state(sheet, rows, [&](double pilot_deg, const Eigen::Matrix3Xd& shape_mm) {
    write_file(
        label.stem + of_state(pilot_deg),
        schema::plate_stl(model_.base(), sheet.panels(), sheet.vertices_mm(), solids, shape_mm));
  });
}

// Writes the plates of a kit to print: a file for each, NAME-kit-r1c2, or all in one.
void ExportFiles::write_print(const solver::Sheet& sheet, const ExportLabel& label) {
  const std::vector<schema::Solid> solids = schema::printed_kit(sheet, kit_of(sheet));
  if (options_.format == ExportFormat::three_mf) {
    return write_file(label.stem + "-kit", schema::three_mf(solids, label.title));
  }
  for (const schema::Solid& solid : solids) {
    write_file(label.stem + "-kit-" + solid.name, schema::binary_stl(solid));
  }
}

schema::KitOptions ExportFiles::kit_of(const solver::Sheet& sheet) const {
  schema::KitOptions kit = *options_.kit;
  const bool is_beyond_d = kit.from_deg && solver::beyond_d(sheet, *kit.from_deg);
  if (is_beyond_d && !options_.must_reach) kit.from_deg.reset();
  return trimmed_kit(sheet, kit, options_.trim_mm);
}

void ExportFiles::write_file(const std::string& stem, const std::string& text) const {
  write_named(stem + ending(options_.format), text);
}

void ExportFiles::write_named(const std::string& name, const std::string& text) const {
  const std::string path = path_of_name(options_, name);
  schema::write_text_file(path, text);
  put(schema::printable(path) + "\n");
}

ExportTables::ExportTables(const FoldingModel& model, const ExportOptions& options,
                           const std::string& stem, const std::string& key)
    : model_(model),
      every_deg_(options.every_deg),
      key_{key, ""},
      diagonals_(path_of(options, stem)) {
  diagonals_.file.write(schema::diagonal_columns(key_));
  if (!options.creases) return;
  creases_.emplace(path_of(options, stem + "-creases"));
  creases_->file.write(schema::crease_columns(key_));
}

void ExportTables::add(const solver::Sheet& sheet, const std::string& key) {
  const schema::FoldingView view(model_.base(), sheet);
  key_.value = key;
  diagonals_.file.write(
      schema::diagonal_rows(key_, view, solver::actuate(sheet, model_.actuators()), every_deg_));
  if (creases_) creases_->file.write(schema::crease_rows(key_, view, every_deg_));
}

void ExportTables::publish() {
  diagonals_.publish();
  if (creases_) creases_->publish();
}

void ExportTables::Table::publish() {
  file.publish();
  put(schema::printable(name) + "\n");
}

}  // namespace misalign::search
