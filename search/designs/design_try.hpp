// Describes a design that was tried, and keeps tries in a file, from which a later run goes on.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "search/designs/card_score.hpp"

namespace misalign::search {

/// Steps by which a sheet came to its design.
enum class DesignStage {
  rough,     ///< few designs were compared
  refined,   ///< the free numbers were searched
  optimised  ///< the sheet was optimised towards the requirement that decided, then refined
};

struct DesignTry {
  std::string how;  ///< the sheet's making
  DesignStage stage = DesignStage::rough;
  schema::Json pattern;  ///< the pattern file with the chosen design; null: there is none
  std::string why;       ///< the reason why there is no sheet, or no card
  std::string chosen;    ///< the free numbers in words
  CardScore score;
  std::vector<std::string> lacks;  ///< labels of requirements that are not met

  bool passes() const { return !pattern.is_null() && score.passes(); }
};

schema::Json design_try_json(const DesignTry& tried);

/// Tries of each finished step by its name.
class DesignLog {
 public:
  /// Reads the tries of an earlier run at this path, if there is a file; an empty path keeps none.
  /// `wish` names the request. UserError (bad_request) where the file is of another request, or
  /// (bad_input) is none of this form.
  DesignLog(std::string path, std::string wish);

  /// Returns the tries of a step; null if it is not finished.
  const std::vector<DesignTry>* find(const std::string& step) const;
  /// Keeps the tries of a finished step: in the file, too.
  void add(const std::string& step, std::vector<DesignTry> tries);

 private:
  std::string path_, wish_;
  std::map<std::string, std::vector<DesignTry>> steps_;
};

}  // namespace misalign::search
