// Studies of one sheet as JSON: what a verb's --json and Python say alike.
#pragma once

#include "schema/exchange/card_json.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/optimise_text.hpp"

namespace misalign::search {

/// With the subject's design. UserError: 2 where an option does not fit the sheet, 1 where its path
/// is lost.
schema::Json contact_said(const Subject& subject, std::optional<double> trim_mm);
schema::Json actuators_said(const Subject& subject);
/// `bends`: also with panels that bend.
schema::Json deploy_said(const Subject& subject, const solver::DeployOptions& options, bool bends);
/// As `misalign optimise --json`.
schema::Json optimise_said(Subject& subject, const ProvenBetter& better);
/// As `misalign card --json`.
schema::Json card_said(const Subject& subject, const schema::Card& card);

}  // namespace misalign::search
