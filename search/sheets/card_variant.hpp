// A change of a card's sheet: another design, or other shifts.
#pragma once

#include <memory>

#include "search/sheets/card_lines.hpp"

namespace misalign::search {

class CardVariant {
 public:
  /// The subject's sheet with another design. `subject` must outlive this object.
  CardVariant(const Subject& subject, const schema::Design& design);
  /// Other shifts of its base, one column per vertex.
  CardVariant(const Subject& subject, const Eigen::Matrix2Xd& shifts_mm);
  explicit CardVariant(const schema::Json& pattern_file);

  CardSheet on() const { return {sheet().chosen, sheet().sheet, design_, used_deg_}; }
  /// Returns whether its path is the subject's: neither shifts nor the angle of use differ.
  bool has_same_path() const { return changed_ == nullptr; }
  schema::Json pattern_file() const;

 private:
  const Subject& sheet() const { return changed_ ? *changed_ : *same_; }

  const Subject* same_ = nullptr;
  std::unique_ptr<const Subject> changed_;
  schema::Design design_;
  double used_deg_ = 0;
};

}  // namespace misalign::search
