// `misalign verify` of a pattern file: one sheet, followed by two solvers, against its folded
// shapes and against what the file says of itself.
#pragma once

#include <string>

#include "schema/pattern/pattern_file.hpp"
#include "search/checks/folded_check.hpp"

namespace misalign::search {

struct PatternVerification {
  std::string pattern;      ///< the file's name without its ending
  schema::Json verdict;     ///< as folding_json.hpp has it
  Eigen::Index shapes = 0;  ///< samples whose folded shapes were looked at
  double apart_mm = 0;      ///< largest difference of any diagonal's length between the two solvers
  bool is_on_base = false;  ///< it is overconstrained, and the second solver is the closed forms
  bool has_claims = false;  ///< whether the file says verdict or metrics of itself: an export does
  ShapeReport report;

  bool good() const { return report.findings.empty(); }
};

/// Follows the path by sparse and by dense matrices and compares verdict, metrics and lengths (of
/// an overconstrained sheet lengths by its loops and by the closed forms of its holes); compares an
/// exported candidate's verdict, metrics and elongations with them; checks the folded shapes up to
/// D, or as far as a sheet folds well that deploys from nothing. UserError (bad_input) as from
/// read_sampled_pattern_file.
PatternVerification verify_pattern(const std::string& path);

std::string pattern_verification_text(const PatternVerification& verification);
schema::Json pattern_verification_json(const PatternVerification& verification);

}  // namespace misalign::search
