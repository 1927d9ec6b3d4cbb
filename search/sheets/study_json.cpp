#include "search/sheets/study_json.hpp"

#include "schema/exchange/actuators_json.hpp"
#include "schema/exchange/contact_json.hpp"
#include "schema/exchange/deploy_json.hpp"
#include "schema/exchange/rubber_json.hpp"
#include "schema/exchange/spring_choice_json.hpp"
#include "schema/exchange/spring_faces_json.hpp"
#include "search/sheets/studies.hpp"

namespace misalign::search {
namespace {

// Adds the key of its sheet.
schema::Json with_key(const Subject& subject, schema::Json json) {
  json.update(subject.chosen.key().json());
  return json;
}

}  // namespace

schema::Json study_json(const Subject& subject, const solver::ContactStudy& study,
                        const std::optional<solver::SpringFaces>& faces) {
  schema::Json json =
      schema::contact_study_json(subject.chosen.base, subject.sheet.panels(), study);
  if (faces) {
    json["springs"]["faces"] = schema::spring_faces_json(subject.sheet.mechanism(), *faces);
  }
  return with_key(subject, std::move(json));
}

schema::Json study_json(const Subject& subject, const solver::Actuation& springs) {
  const schema::FoldingView view(subject.chosen.base, subject.sheet);
  schema::Json json = schema::actuation_history_json(view, springs);
  json["deploys_from_deg"] = view.sheet.sample_deg(view.history.verdict.deploys_from_sample);
  if (const auto rubber = rubber_of(subject.sheet, springs)) {
    json["rubber"] = schema::rubber_json(subject.chosen.base, *rubber);
  }
  return with_key(subject, std::move(json));
}

schema::Json study_json(const Subject& subject, const solver::SpringChoice& choice) {
  const solver::Sheet& sheet = subject.sheet;
  return with_key(
      subject, {{"deploys_from_deg", sheet.deploys_from_deg()},
                {"choice", schema::spring_choice_json(sheet.base(), sheet.mechanism(), choice)}});
}

schema::Json study_json(const Subject& subject, const schema::SpringOrder& order) {
  const solver::Sheet& sheet = subject.sheet;
  return with_key(subject,
                  {{"deploys_from_deg", sheet.deploys_from_deg()},
                   {"bought", schema::spring_order_json(sheet.base(), sheet.mechanism(), order)}});
}

schema::Json study_json(const Subject& subject, const ReleasedSheet& released) {
  schema::Json json = schema::deployment_history_json(subject.sheet, released.motion);
  json["deploys_from_deg"] = subject.sheet.deploys_from_deg();
  if (released.bent) json["bent"] = schema::bent_panels_json(*released.bent);
  if (released.pins) json["pins"] = schema::pins_json(*released.pins);
  return with_key(subject, std::move(json));
}

schema::Json study_json(const Subject& subject, const schema::Card& card) {
  return with_key(subject, schema::card_json(card));
}

schema::Json study_json(Subject& subject, const ProvenBetter& better) {
  const solver::Sheet sheet = subject.model.sheet(better.found.best().shifts_mm);
  return schema::optimise_json(sheet, better.found, better.certified_deg,
                               better_pattern(subject, better));
}

}  // namespace misalign::search
