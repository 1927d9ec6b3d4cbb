// The details that a report's page carries of each sheet that can be looked at closely.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/report/stress_result.hpp"
#include "search/sheets/contact_study.hpp"
#include "search/sheets/deployer.hpp"
#include "search/sheets/folded_sheet.hpp"

namespace misalign::search {

/// What is asked for beyond what every page has.
struct DetailOptions {
  bool contact = false;                   ///< where panels meet
  std::vector<std::string> stress_files;  ///< of `misalign stress`
};

class ReportDetails {
 public:
  /// Reads the files of `options`; UserError (3). `folder` must outlive this object.
  ReportDetails(const SheetFolder& folder, const DetailOptions& options);

  /// Of a draw of a campaign.
  schema::Json of_draw(const FoldedSheet& folded, std::uint64_t draw, bool accepted);
  /// Of a pattern file's sheet, which nobody accepted.
  schema::Json of_pattern(const FoldedSheet& folded, const std::string& name);

  /// The draws that the stress files are of. UserError (3) where one is of no draw of this
  /// campaign; (2) where two are of the same.
  std::vector<std::uint64_t> draws_with_stress(const schema::Campaign& campaign) const;
  /// UserError as above, of the file's only sheet.
  void check_stress(const std::string& path, const std::string& fingerprint) const;

 private:
  schema::Json detail(const FoldedSheet& folded, std::uint64_t draw, bool accepted);
  schema::Json deployment(const FoldedSheet& folded);
  schema::Json contact(const FoldedSheet& folded);

  const SheetFolder& folder_;
  std::vector<schema::StressResult> stress_;
  Deployer deployer_;
  std::optional<ContactStudier> contact_;
};

}  // namespace misalign::search
