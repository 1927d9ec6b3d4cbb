// Where the panels of one sheet meet, how close they come before, and how thick they may be.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/campaign/pattern_file.hpp"
#include "solver/design/contact.hpp"
#include "solver/model/model.hpp"

namespace misalign::search {

class ContactStudier {
 public:
  /// `base` must outlive this object.
  ContactStudier(const schema::Pattern& base, const schema::Sampling& sampling);
  ContactStudier(const ContactStudier&) = delete;
  ContactStudier& operator=(const ContactStudier&) = delete;

  /// Of the sheet with these shifts, its corners trimmed by so much (none: kTrimPart of the panel
  /// width). UserError: 2 where that leaves nothing of an edge, 1 where the path is lost; `name` is
  /// the sheet's in the sentence.
  solver::ContactStudy study(const Eigen::Matrix2Xd& shifts_mm, std::optional<double> trim_mm,
                             const std::string& name);

  const schema::Pattern& base() const { return base_; }
  const solver::Panels& panels() const { return panels_; }

 private:
  double checked_trim_mm(std::optional<double> trim_mm, const solver::FlatVertices& vertices_mm,
                         const std::string& name) const;

  const schema::Pattern& base_;
  const double sample_deg_;
  const solver::Model model_;
  const solver::Panels panels_;
  solver::ResolvedWay ways_;
};

}  // namespace misalign::search
