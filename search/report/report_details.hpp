// Computes the details of each sheet that a report's page can show closely.
#pragma once

#include <string>
#include <vector>

#include "schema/report/stress_result.hpp"
#include "search/sheets/folding_model.hpp"

namespace misalign::search {

/// Details that a page has on request alone.
struct DetailOptions {
  bool contact = false;                   ///< add the contact of panels
  std::vector<std::string> stress_files;  ///< results of `misalign stress`
};

class ReportDetails {
 public:
  /// Reads the files of `options`; UserError (bad_input). `model` must outlive this object. Sheets
  /// are shown on the target, unless it is null.
  ReportDetails(FoldingModel& model, const DetailOptions& options, const schema::Target* target);

  /// Returns the details of a campaign's draw.
  schema::Json of_draw(const solver::Sheet& sheet, std::uint64_t draw, bool accepted) const;
  /// Returns the details of a pattern file's sheet, which has no verdict of a campaign.
  schema::Json of_pattern(const solver::Sheet& sheet, const std::string& name) const;

  /// Returns the draws of the stress files. UserError: bad_input if a file is of no draw of this
  /// campaign; bad_request if two are of the same draw.
  std::vector<std::uint64_t> draws_with_stress(const schema::Campaign& campaign) const;
  /// Checks the stress files against a pattern file's only sheet; UserError as above.
  void check_stress(const std::string& path, const std::string& fingerprint) const;

 private:
  schema::Json detail(const solver::Sheet& sheet, std::uint64_t draw, bool accepted) const;
  schema::Json deployment(const solver::Sheet& sheet) const;
  schema::Json contact(const solver::Sheet& sheet) const;
  std::optional<double> from_of(const solver::Sheet& sheet) const;

  const FoldingModel& model_;
  const bool with_contact_;
  std::vector<schema::StressResult> stress_;
  std::optional<solver::ShapeMeasure> measure_;  // of the target
};

}  // namespace misalign::search
