#include "search/sheets/sheet_said.hpp"

#include "schema/exchange/contact_json.hpp"
#include "schema/exchange/deploy_json.hpp"
#include "search/sheets/contact_text.hpp"

namespace misalign::search {
namespace {

// With whose it is.
schema::Json said_of(const Subject& subject, schema::Json json) {
  json.update(subject.chosen.key().json());
  return json;
}

}  // namespace

schema::Json contact_said(const Subject& subject, std::optional<double> trim_mm) {
  const solver::ContactStudy study =
      contact_of(subject.sheet, {trim_mm, subject.model.design().from_deg});
  return said_of(subject,
                 schema::contact_study_json(subject.chosen.base, subject.sheet.panels(), study));
}

schema::Json actuators_said(const Subject& subject) {
  return said_of(subject, springs_json({subject.chosen.base, subject.sheet},
                                       actuated(subject.sheet, subject.model.design())));
}

schema::Json deploy_said(const Subject& subject, const solver::DeployOptions& options, bool bends) {
  schema::Json json =
      schema::deployment_history_json(subject.sheet.mechanism(), deployed(subject.sheet, options));
  json["deploys_from_deg"] = subject.sheet.deploys_from_deg();
  if (bends) {
    json["bent"] =
        schema::bent_panels_json(bent_sheet(subject.sheet, options, subject.model.design()));
  }
  if (const auto pins = pins_of(subject.sheet, options, subject.model.design())) {
    json["pins"] = schema::pins_json(*pins);
  }
  return said_of(subject, std::move(json));
}

schema::Json optimise_said(Subject& subject, const ProvenBetter& better) {
  const solver::Sheet sheet = subject.model.sheet(better.found.best().shifts_mm);
  return schema::optimise_json(sheet, better.found, better.certified_deg,
                               better_pattern(subject, better));
}

schema::Json card_said(const Subject& subject, const schema::Card& card) {
  return said_of(subject, schema::card_json(card));
}

}  // namespace misalign::search
