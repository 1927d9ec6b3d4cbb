// The details that a report's page carries of each sheet that can be looked at closely.
#pragma once

#include <string>
#include <vector>

#include "schema/report/stress_result.hpp"
#include "search/sheets/folding_model.hpp"

namespace misalign::search {

/// What is asked for beyond what every page has.
struct DetailOptions {
  bool contact = false;                   ///< where panels meet
  std::vector<std::string> stress_files;  ///< of `misalign stress`
};

class ReportDetails {
 public:
  /// Reads the files of `options`; UserError (bad_input). `model` must outlive this object.
  ReportDetails(const FoldingModel& model, const DetailOptions& options);

  /// Of a draw of a campaign.
  schema::Json of_draw(const solver::Sheet& sheet, std::uint64_t draw, bool accepted) const;
  /// Of a pattern file's sheet, which nobody accepted.
  schema::Json of_pattern(const solver::Sheet& sheet, const std::string& name) const;

  /// The draws that the stress files are of. UserError (bad_input) where one is of no draw of this
  /// campaign; bad request where two are of the same.
  std::vector<std::uint64_t> draws_with_stress(const schema::Campaign& campaign) const;
  /// UserError as above, of the file's only sheet.
  void check_stress(const std::string& path, const std::string& fingerprint) const;

 private:
  schema::Json detail(const solver::Sheet& sheet, std::uint64_t draw, bool accepted) const;
  schema::Json deployment(const solver::Sheet& sheet) const;
  schema::Json contact(const solver::Sheet& sheet) const;
  std::optional<double> from_of(const solver::Sheet& sheet) const;

  const FoldingModel& model_;
  const bool with_contact_;
  std::vector<schema::StressResult> stress_;
};

}  // namespace misalign::search
