// `misalign export`: chosen candidates as files.
#pragma once

#include "search/choice.hpp"
#include "solver/actuation.hpp"

namespace misalign::search {

enum class ExportFormat { json, csv, fold, svg, obj };

/// Springs other than the campaign's; what is absent stays.
struct OtherActuators {
  std::optional<double> stiffness_n_per_mm, stroke_limit;
  solver::Actuators instead_of(solver::Actuators actuators) const;
};

struct ExportOptions {
  std::string catalogue_path;
  Choice choice;
  ExportFormat format = ExportFormat::json;
  double step_deg = 10;  ///< between two states of `fold` and `obj`
  OtherActuators actuators;
  std::string output;  ///< directory
};

/// Writes each candidate's files whole or not at all, and prints their names.
void export_candidates(const ExportOptions& options);

/// Whole or not at all: a full disk leaves no half of a file under its name. UserError (1).
void write_file(const std::string& path, const std::string& text);

}  // namespace misalign::search
