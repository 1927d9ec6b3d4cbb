// Runs `misalign verify` on a pattern file: compares two solvers, the folded shapes and the file's
// own values.
#pragma once

#include <string>

#include "schema/pattern/pattern_file.hpp"
#include "search/checks/folded_check.hpp"

namespace misalign::search {

struct PatternVerification {
  std::string pattern;      ///< the file's name without its ending
  schema::Json verdict;     ///< see folding_json.hpp
  Eigen::Index shapes = 0;  ///< samples whose folded shapes were checked
  double apart_mm = 0;      ///< largest difference of any diagonal's length between the two solvers
  bool is_on_base = false;  ///< true if it is overconstrained: closed forms are the second solver
  bool has_claims = false;  ///< true if the file, an export, has a verdict or metrics
  ShapeReport report;

  bool good() const { return report.findings.empty(); }
};

/// Follows the path in the fixed order of elimination and with pivoting, and compares verdict,
/// metrics and lengths. An overconstrained sheet's lengths are compared with the closed forms of
/// its holes. Compares an exported candidate's verdict, metrics and elongations, and checks the
/// folded shapes up to D, or as far as it folds well if D is 0. UserError (bad_input) as from
/// read_sampled_pattern_file.
PatternVerification verify_pattern(const std::string& path);

std::string pattern_verification_text(const PatternVerification& verification);
schema::Json pattern_verification_json(const PatternVerification& verification);

}  // namespace misalign::search
