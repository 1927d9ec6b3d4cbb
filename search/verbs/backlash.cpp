// `misalign tolerance --backlash`: how often a sheet is monotone when its joints have play.
#include "search/sheets/backlash.hpp"

#include <fmt/format.h>

#include "schema/exchange/backlash_json.hpp"
#include "schema/pattern/parameters.hpp"
#include "search/sheets/backlash_text.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/tolerance_call.hpp"

namespace misalign::search {
namespace {

using schema::UserError;

void refuse_backlash(const ToleranceCall& call, const ToleranceTargets& sheets,
                     const BacklashStudy& study) {
  for (std::size_t k = 0; k < study.sheets().size(); ++k) {
    const std::string name = sheets.key(k).name();
    if (call.backlash.from_deg >= study.sheets()[k].to_deg) {
      throw UserError(schema::Cause::bad_request,
                      fmt::format("--backlash-from {}: must be below {} deg (where the range "
                                  "of angles of {} ends); try {}",
                                  schema::shown_number(call.backlash.from_deg),
                                  schema::shown_number(study.sheets()[k].to_deg), name,
                                  fmt::format("{:.2g}", 0.1 * study.sheets()[k].to_deg)));
    }
    if (*call.backlash_mm >= study.most_mm(k)) {
      throw UserError(
          schema::Cause::bad_request,
          fmt::format("--backlash {}: must be below {:.4g} mm (a tenth of the shortest crease of "
                      "{}: hinges looser than that have no direction); try {:.1g}",
                      schema::shown_number(*call.backlash_mm), study.most_mm(k), name,
                      study.most_mm(k) / 1000));
    }
  }
}

}  // namespace

void check_backlash(const ToleranceCall& call) {
  if (call.study.trials > schema::kMostBacklashTrials) {
    throw UserError(schema::Cause::bad_request,
                    fmt::format("--trials {}: at most {} with --backlash (each is kept until all "
                                "are counted); 1000 give the share to within 1.4 %",
                                call.study.trials, schema::kMostBacklashTrials));
  }
}

void run_backlash(const ToleranceCall& call, const ToleranceTargets& sheets) {
  solver::BacklashOptions options = call.backlash;
  options.used_from_deg = call.from_deg ? call.from_deg : sheets.design.from_deg;
  const BacklashStudy study(sheets.campaign, sheets.shifts_mm, options,
                            sheets.design.fill(sheets.campaign.pattern.base));
  refuse_backlash(call, sheets, study);
  const schema::Campaign used = campaign_of_use(call, sheets);
  std::vector<solver::Backlash> answers =
      study.run({*call.backlash_mm, call.study.trials, call.study.jobs, show_copies});
  std::vector<NamedBacklash> named;
  schema::Json list = schema::Json::array();
  for (std::size_t k = 0; k < answers.size(); ++k) {
    // A pattern file's threshold is its D.
    const bool is_asked = call.from_deg || sheets.design.from_deg || !sheets.draws.empty();
    named.push_back({sheets.key(k).name(), std::move(answers[k]),
                     is_asked ? std::optional(used.threshold_deg) : std::nullopt});
    list.push_back(schema::backlash_json(named.back().backlash, named.back().threshold_deg));
    list.back().update(sheets.key(k).json());
  }
  const bool single = is_single(call, sheets);
  if (call.json) {
    put_json((single ? list.front() : list).dump(1) + "\n");
  } else {
    put(named.size() == 1 ? backlash_text(named.front()) : backlashes_text(std::move(named)));
  }
}

}  // namespace misalign::search
