// The common part of the proofs of `misalign certify`: the request, and the sheet.
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
  bool all = false, closed_form = false, wells = false, json = false;
  schema::Design design;  // overrides the sheet's filling, for its wells
};

/// The document of an exported sheet, or one made like it.
schema::Json document_of(const ChosenSheet& sheet);

/// The sheet's D; UserError (bad_input) where it does not deploy.
double deploys_from_deg(const solver::Sheet& sheet, const std::string& path);

/// Proves in rational numbers that all equations of sheets of the parallel family hold.
/// UserError (bad_request) for options that such proofs have not, (bad_input) for a sheet that is
/// off the family, or an unprovable base. Returns exit codes.
void check_closed_form(const CertifyCall& call);
int prove_in_closed_form(const CertifyCall& call, const ChosenSheet& chosen,
                         const solver::Model& model);
/// The chosen candidates of a catalogue.
int prove_in_closed_form(const CertifyCall& call);

/// Proves the wells of the energy, of a pattern file or of the chosen candidates of a catalogue.
/// UserError as choose_sheet and deploys_from_deg, (bad_request) for fillings without such a proof.
/// Returns the exit code.
int prove_wells(const CertifyCall& call);

}  // namespace misalign::search
