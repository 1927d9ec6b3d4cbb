// The common part of the proofs of `misalign certify`: what was asked, and of which sheet.
#pragma once

#include <string>

#include "search/ranks/certify_run.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/verbs/choice_options.hpp"

namespace misalign::search {

struct CertifyCall {
  CertifyOptions options;
  Choice choice;
  std::string ranks;  // as typed; empty where they were not
  bool all = false, closed_form = false, json = false;
};

/// The file's own if it was exported, otherwise written as if it had been.
schema::Json document_of(const ChosenSheet& sheet);

/// Of the sheet; UserError (bad_input) where it deploys from nothing.
double deploys_from_deg(const solver::Sheet& sheet, const std::string& path);

/// Sheets of the parallel family, in rational numbers: that all equations hold, spare ones too.
/// UserError (bad_request) for options that such proofs have not, (bad_input) for a sheet that is
/// off the family, or a base of which it cannot be proven. Exit codes.
void check_closed_form(const CertifyCall& call);
int prove_in_closed_form(const CertifyCall& call, const ChosenSheet& chosen,
                         const solver::Model& model);
/// The chosen candidates of a catalogue.
int prove_in_closed_form(const CertifyCall& call);

}  // namespace misalign::search
