// Proofs in closed form of `misalign certify`.
#include <fmt/format.h>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/exchange/certify_json.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "search/draws/models.hpp"
#include "search/sheets/campaign_sheet.hpp"
#include "search/sheets/certify_text.hpp"
#include "search/sheets/springs_at_vertices.hpp"
#include "search/sheets/study_functions.hpp"
#include "search/terminal/long_work.hpp"
#include "search/terminal/shell_word.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/certify_call.hpp"
#include "solver/certificate/member_proof.hpp"
#include "solver/pattern/parallel_family.hpp"

namespace misalign::search {
namespace {

using schema::Json;
using schema::UserError;

// The proof of one sheet, as text and as JSON.
struct Proven {
  std::string text;
  Json json;
};

Proven prove(const CertifyCall& call, const ChosenSheet& chosen, const solver::Model& model) {
  need_springs_at_vertices(model.base().springs, "certify: proofs");
  const std::string& path = call.options.path;
  const std::string where = chosen.drawn ? path + ": " + chosen.key().name() : path;
  const double off_mm = solver::parallel_misfit(chosen.base.base, chosen.shifts_mm).mm;
  if (off_mm > solver::kMemberWithin_mm) {
    throw UserError(schema::Cause::bad_input,
                    where +
                        ": creases do not keep the base's directions, or holes are no "
                        "parallelograms any more (" +
                        schema::shown_number(off_mm) +
                        " mm off), so that there is no closed form; take --closed-form out");
  }
  solver::SheetSolver solver(model);
  const solver::Sheet sheet(solver, chosen.shifts_mm);
  const double asked_deg = call.options.to_deg      ? *call.options.to_deg
                           : chosen.design.from_deg ? *chosen.design.from_deg
                                                    : deploys_from_deg(sheet, path);
  const solver::MemberProof proof = solver::prove_member(sheet.base(), chosen.shifts_mm, asked_deg);
  if (!proof.holds()) {
    throw UserError(schema::Cause::bad_input,
                    where + ": the sheet's folding cannot be proven exactly: " +
                        proof.gap.why(sheet.base().sheet) +
                        "; take a base of the family \"miura\", or as many holes as count to one "
                        "degree of freedom");
  }
  return {member_proof_text(chosen.base, chosen.key().name(), proof, asked_deg),
          schema::member_proof_json(chosen.base, proof, asked_deg)};
}

}  // namespace

Json document_of(const ChosenSheet& sheet) {
  Json document = sheet.exported;
  if (!document.is_object() || !document.contains("pattern")) {
    document = schema::pattern_file_json(sheet.base, sheet.shifts_mm, sheet.sampling, sheet.design);
    if (sheet.exported.is_object() && sheet.exported.contains("draw")) {
      document["draw"] = sheet.exported["draw"];
    }
  }
  return document;
}

double deploys_from_deg(const solver::Sheet& sheet, const std::string& path) {
  if (sheet.deploys_from_deg() > 0) return sheet.deploys_from_deg();
  throw UserError(
      schema::Cause::bad_input,
      path +
          ": the sheet does not deploy (D = 0), so there is nothing to certify; give an angle with "
          "--to, or see its first fault: misalign fold " +
          shell_path(path));
}

void check_closed_form(const CertifyCall& call) {
  for (const auto& [is_given, option, why] :
       {std::tuple(call.options.check, "--check", "the proof is made anew in no time"),
        std::tuple(call.options.criterion == solver::CertifiedBy::energy, "--criterion energy",
                   "it proves that diagonals are monotone"),
        std::tuple(call.options.contact, "--contact",
                   "`misalign contact` says where panels meet")}) {
    if (!is_given) continue;
    throw UserError(schema::Cause::bad_request, call.options.path +
                                                    ": is proven in closed form, which has no " +
                                                    option + " (" + why + "); take it out");
  }
}

int prove_in_closed_form(const CertifyCall& call, const ChosenSheet& chosen,
                         const solver::Model& model) {
  const Proven proven = prove(call, chosen, model);
  if (!call.json) return put(proven.text), 0;
  Json document = document_of(chosen);
  document["member_proof"] = proven.json;
  put_json(document);
  return 0;
}

int prove_in_closed_form(const CertifyCall& call) {
  const std::string& path = call.options.path;
  const auto database = schema::open_for_reading(path);
  const schema::Campaign campaign = schema::read_campaign_of(*database, path);
  add_study_functions(*database, campaign, path);
  const solver::Model model = model_of(campaign);
  const LongWork work("certify is under way", work_style(), false);
  std::string text;
  Json list = Json::array();
  const std::vector<std::uint64_t> draws = chosen_draws(*database, call.choice);
  for (const std::uint64_t draw : draws) {
    const ChosenSheet chosen{campaign.pattern,
                             campaign.sampling(),
                             campaign.design,
                             shifts_of_number(*database, campaign, draw),
                             ChosenSheet::Drawn{campaign, draw},
                             "",
                             {}};
    const Proven proven = prove(call, chosen, model);
    list.push_back(proven.json);
    list.back()["draw"] = draw;
    text += draws.size() > 1 ? proven.text.substr(0, proven.text.find('\n') + 1) : proven.text;
    show_work("candidates proven", list.size(), draws.size());
  }
  if (!call.json) return put(text), 0;
  put_json(call.choice.draws.size() == 1 ? list.front() : list);
  return 0;
}

}  // namespace misalign::search
