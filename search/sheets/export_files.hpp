// A folded sheet as files: its data, crease pattern, folded states or model for a simulator, or its
// rows of one table.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "schema/exchange/calculix_deck.hpp"
#include "schema/exchange/history_table.hpp"
#include "schema/exchange/mjcf_export.hpp"
#include "schema/files/output_file.hpp"
#include "schema/kit/kit_drawing.hpp"
#include "search/sheets/release.hpp"
#include "solver/kinematics/filler.hpp"

namespace misalign::search {

enum class ExportFormat { json, csv, mat, fold, svg, dxf, obj, stl, three_mf, mjcf, inp };

struct ExportOptions {
  std::string read_from;  ///< the catalogue or pattern file; is not replaced
  std::string directory;
  ExportFormat format = ExportFormat::json;
  double step_deg = 10;      ///< step between states of `fold`, `obj`, `stl`
  bool joined = false;       ///< fillers join all panels of `fold`
  bool creases = false;      ///< also a table of fold angles beside `csv`
  double every_deg = 0;      ///< rows of `csv`, see diagonal_rows()
  SimulationStart release;   ///< `mjcf` and `inp` use it, `stl` its plates
  schema::DeckOptions deck;  ///< `inp` uses it
  /// Replaces the crease pattern of `svg` and `dxf`, the folded plates of `stl`.
  std::optional<schema::KitOptions> kit;
  bool only_cut = false;                         ///< leaves other layers out of `svg`, `dxf`
  std::function<void(const std::string&)> warn;  ///< gets warnings
  /// Trim of the plates' corners in `stl` and kits (none: that of ContactOptions).
  std::optional<double> trim_mm;
  /// True if an angle of use beyond D is refused; otherwise kits end at D.
  bool must_reach = false;

  bool in_states() const {
    return format == ExportFormat::fold || format == ExportFormat::obj ||
           (format == ExportFormat::stl && !kit);
  }
  /// Returns whether a kit is one of solids to print.
  bool is_printed() const {
    return format == ExportFormat::stl || format == ExportFormat::three_mf;
  }
  bool is_drawn() const { return format == ExportFormat::svg || format == ExportFormat::dxf; }
  bool is_simulated() const { return format == ExportFormat::mjcf || format == ExportFormat::inp; }
  /// Returns whether files depend on the angle of use.
  bool knows_angle_of_use() const {
    return format == ExportFormat::json || format == ExportFormat::fold ||
           format == ExportFormat::stl || is_simulated() || kit.has_value();
  }
  /// Step of the stations that a history needs beside samples; 0: none.
  double look_deg() const { return in_states() ? step_deg : 0; }
};

/// UserError (failure) if there is no such directory and none can be made.
void make_directory(const std::string& path);

/// Names of a sheet's files, and the title in them.
struct ExportLabel {
  std::string stem, title;
};

/// One sheet's files, of any format but csv; prints their names. Refers to what it was made of.
/// UserError (bad_request) if one of them is the file that is read, the plates are thicker than
/// reaches the angle of use, or no fillers join the panels.
class ExportFiles {
 public:
  ExportFiles(const FoldingModel& model, const ExportOptions& options);

  /// `origin`: the keys of the campaign that drew it, if there is one.
  void write(const solver::Sheet& sheet, const ExportLabel& label, const schema::Json& origin);

 private:
  schema::Json data_of(const solver::Sheet& sheet, const schema::Json& origin);
  std::string fold_text(const solver::Sheet& sheet, const ExportLabel& label,
                        const schema::Json& origin);
  std::vector<solver::Filler> fillers_of(const solver::Sheet& sheet,
                                         const std::vector<Eigen::Index>& rows) const;
  std::string simulated(const solver::Sheet& sheet, const ExportLabel& label) const;
  void write_drawings(const solver::Sheet& sheet, const ExportLabel& label);
  std::string guide_of(const solver::Sheet& sheet, const ExportLabel& label,
                       const schema::KitOptions& options, const schema::Kit& kit) const;
  void write_states(const solver::Sheet& sheet, const ExportLabel& label) const;
  schema::KitOptions kit_of(const solver::Sheet& sheet) const;
  void write_print(const solver::Sheet& sheet, const ExportLabel& label);
  void write_plates(const solver::Sheet& sheet, const ExportLabel& label);
  void write_file(const std::string& stem, const std::string& text) const;
  void write_named(const std::string& name, const std::string& text) const;
  const solver::Sheet& at_samples(const solver::Sheet& sheet,
                                  std::optional<solver::Sheet>& another);

  const FoldingModel& model_;
  const ExportOptions& options_;
  std::optional<FoldingModel> at_samples_;  // of states between the samples nothing else depends
};

/// All sheets as one long table, and on request another of creases. A sheet's rows are written as
/// soon as they are known: any number of sheets takes the room of one. UserError as above.
class ExportTables {
 public:
  ExportTables(const FoldingModel& model, const ExportOptions& options, const std::string& stem,
               const std::string& key);

  void add(const solver::Sheet& sheet, const std::string& key);
  /// The files are there from now on; prints their names.
  void publish();

 private:
  struct Table {
    explicit Table(const std::string& path) : name(path), file(schema::OutputFile::text(path)) {}
    void publish();
    const std::string name;
    schema::OutputFile file;
  };

  const FoldingModel& model_;
  const double every_deg_;
  schema::RowKey key_;
  Table diagonals_;
  std::optional<Table> creases_;
};

}  // namespace misalign::search
