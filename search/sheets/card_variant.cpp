#include "search/sheets/card_variant.hpp"

#include "search/sheets/card.hpp"

namespace misalign::search {
namespace {

std::unique_ptr<const Subject> subject_of(const schema::Json& pattern_file) {
  return std::make_unique<const Subject>(sheet_of_made_pattern(pattern_file, "the changed sheet"),
                                         schema::Design{});
}

schema::Json pattern_file_of(const ChosenSheet& chosen, const Eigen::Matrix2Xd& shifts_mm,
                             const schema::Design& design) {
  return schema::pattern_file_json(chosen.base, shifts_mm, chosen.sampling, design, chosen.target);
}

}  // namespace

CardVariant::CardVariant(const Subject& subject, const schema::Design& design)
    : same_(&subject), design_(design) {
  if (design.from_deg != subject.model.design().from_deg) {
    changed_ = subject_of(pattern_file_of(subject.chosen, subject.chosen.shifts_mm, design));
  }
  used_deg_ = card_sheet(sheet()).used_deg;
}

CardVariant::CardVariant(const Subject& subject, const Eigen::Matrix2Xd& shifts_mm)
    : CardVariant(pattern_file_of(subject.chosen, shifts_mm, subject.model.design())) {}

CardVariant::CardVariant(const schema::Json& pattern_file)
    : changed_(subject_of(pattern_file)), design_(changed_->model.design()) {
  used_deg_ = card_sheet(*changed_).used_deg;
}

schema::Json CardVariant::pattern_file() const {
  const ChosenSheet& chosen = sheet().chosen;
  return pattern_file_of(chosen, chosen.shifts_mm, design_);
}

}  // namespace misalign::search
