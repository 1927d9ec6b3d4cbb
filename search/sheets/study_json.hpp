// Studies of one sheet as JSON: what a verb's --json and Python give alike.
#pragma once

#include "schema/exchange/card_json.hpp"
#include "schema/exchange/stock_choice_json.hpp"
#include "search/sheets/better_sheet.hpp"
#include "search/sheets/studies.hpp"

namespace misalign::search {

/// The JSON of `misalign contact`, `actuators`, `deploy`, `card` and `optimise`.
schema::Json study_json(const Subject& subject, const solver::ContactStudy& study,
                        const std::optional<solver::SpringFaces>& faces = {});
schema::Json study_json(const Subject& subject, const solver::Actuation& springs);
schema::Json study_json(const Subject& subject, const solver::SpringChoice& choice);
schema::Json study_json(const Subject& subject, const schema::SpringOrder& order);
schema::Json study_json(const Subject& subject, const ReleasedSheet& released);
schema::Json study_json(const Subject& subject, const schema::Card& card);
schema::Json study_json(Subject& subject, const ProvenBetter& better);

}  // namespace misalign::search
