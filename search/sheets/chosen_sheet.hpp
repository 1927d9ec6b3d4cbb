// The sheet that a verb is about: a draw of a catalogue's campaign, or a pattern file's.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "schema/pattern/pattern_file.hpp"
#include "search/sheets/folding_model.hpp"
#include "solver/records/certificate.hpp"

namespace misalign::search {

/// The key of a sheet: a draw of a campaign, or a pattern file.
struct SheetKey {
  std::optional<std::uint64_t> draw;
  std::string pattern;  ///< name of a pattern file without its ending

  /// "draw 7", or the pattern's name.
  std::string name() const;
  /// {"draw": 7}, or {"pattern": "table1"}: the key that data carry.
  schema::Json json() const;
};

struct ChosenSheet {
  schema::Pattern base;
  schema::Sampling sampling;
  schema::Design design;
  Eigen::Matrix2Xd shifts_mm;
  /// The campaign that drew it; none for a pattern file.
  struct Drawn {
    schema::Campaign campaign;
    std::uint64_t draw;
  };
  std::optional<Drawn> drawn;
  std::string pattern;    ///< the key's
  schema::Json exported;  ///< an exported candidate's file; null otherwise
  std::optional<schema::Target> target = std::nullopt;  ///< a pattern file's, or the campaign's

  /// Makes a campaign of the sheet alone, with the first sample as threshold and the default seed:
  /// an exported candidate does not say its campaign's.
  schema::Campaign as_campaign() const;

  /// Judges it by the energy of this filling, or by diagonals.
  void judge_by(const std::optional<solver::Fill>& fill);

  SheetKey key() const { return {drawn ? std::optional(drawn->draw) : std::nullopt, pattern}; }
  /// The same with the draw's "campaign", or a fingerprint of the pattern's "sheet".
  schema::Json whose() const;
  /// "draw 7 of miura-6x6", or the pattern's name.
  std::string name() const { return key().name() + (drawn ? " of " + drawn->campaign.name : ""); }
};

/// Returns whether a file holds JSON or OBJ, and so a pattern, instead of a catalogue. False also
/// for unreadable files: opening them as a catalogue says why.
bool is_pattern_file(const std::string& path);

/// Logs how its mesh was read where the file leaves a choice.
void say_reading(const std::string& source, const schema::Pattern& pattern);

/// A pattern, an exported candidate, a FOLD or an OBJ file, sampled as `misalign fold` does, with
/// its design. UserError (bad_input) with every fault.
ChosenSheet sheet_of_pattern_file(
    const std::string& path, schema::Perforations perforations = schema::Perforations::of_one_path);

/// The same of a document that was read.
ChosenSheet sheet_of_pattern_document(const schema::Json& document, const std::string& source,
                                      const std::filesystem::path& directory,
                                      const std::string& name, schema::Perforations perforations);

/// A pattern file that the program made: it names no other file.
ChosenSheet sheet_of_made_pattern(const schema::Json& document, const std::string& name);

/// A draw of a campaign.
ChosenSheet sheet_of_draw(schema::Campaign campaign, std::uint64_t draw,
                          Eigen::Matrix2Xd shifts_mm);

/// A sheet to study, its model and design, and what was chosen.
struct Subject {
  Subject(ChosenSheet what, const schema::Design& options);

  const ChosenSheet chosen;
  FoldingModel model;
  const solver::Sheet sheet;
};

/// The sheet of a pattern file, or of a draw of a catalogue's campaign, accepted or not; `options`
/// override the file's design, and `criterion` how the sheet is judged: by the energy of the
/// filling that judges it, else of the design's. UserError: 2 no draw of a catalogue, or one of a
/// pattern file, or a filling that judges no sheet; 3 as above and as from open_for_reading.
Subject choose_sheet(const std::string& path, std::optional<std::uint64_t> draw,
                     const schema::Design& options = {},
                     std::optional<solver::CertifiedBy> criterion = {});

/// A station at the angle of use, where no sample is.
StationOptions station_of_use(const schema::Design& design, const schema::Sampling& sampling);

/// Warns where a sheet is released beyond D: not all of its diagonals are monotone there.
void warn_beyond_d(const solver::Sheet& sheet, std::optional<double> from_deg);

/// UserError (bad_request) with one sentence: a pattern file is one sheet, so `what` has no
/// meaning.
schema::UserError only_of_a_catalogue(const std::string& path, const std::string& what);

}  // namespace misalign::search
