// The study of joint gaps of `misalign tolerance`: how far joints of miscut copies stay open.
#include "schema/exchange/tolerance_json.hpp"
#include "search/sheets/studies.hpp"
#include "search/sheets/tolerance_text.hpp"
#include "search/terminal/long_work.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/tolerance_call.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::search {
namespace {

constexpr double kStep_deg = 10;
// Dense matrices of six numbers a panel, and three a joint and copy, take a minute and 200 MB.
constexpr std::size_t kMostPanels = 400;
constexpr std::uint64_t kMostCopies = 20000;

// The rows up to the angle of use, or D.
std::vector<Eigen::Index> rows_up_to(const solver::Sheet& sheet, double from_deg) {
  std::vector<Eigen::Index> rows;
  for (const Eigen::Index row : sheet.rows_to_show(kStep_deg)) {
    const double at_deg = sheet.history().stations[static_cast<std::size_t>(row)].pilot_deg;
    if (at_deg <= from_deg + 1e-9) rows.push_back(row);
  }
  return rows;
}

void refuse(const ToleranceCall& call, const std::string& option, const char* why) {
  throw study_error(solver::NoResult::overconstrained, call.path,
                    option + " has no meaning (" + why + ")", "take it out");
}

}  // namespace

void run_gaps(const ToleranceCall& call, const ToleranceTargets& sheets) {
  if (call.backlash_mm) refuse(call, "--backlash", "its loops close by their shapes alone");
  if (call.study.vertices) refuse(call, "--vertices", "no copy folds, so none deploys");
  if (sheets.shifts_mm.size() != 1) {
    throw schema::UserError(schema::Cause::bad_request,
                            call.path +
                                ": too many sheets (joint gaps of overconstrained sheets are found "
                                "one sheet at a time, and " +
                                std::to_string(sheets.shifts_mm.size()) +
                                " are chosen); name one draw");
  }
  if (call.study.trials > kMostCopies) {
    throw schema::UserError(
        schema::Cause::bad_request,
        "--trials " + std::to_string(call.study.trials) + ": too many (at most " +
            std::to_string(kMostCopies) +
            " copies of an overconstrained sheet are studied at once); take fewer");
  }
  const schema::Campaign& campaign = sheets.campaign;
  const Eigen::Matrix2Xd& shifts_mm = sheets.shifts_mm.front();
  check_miscut(*call.amplitude_mm, campaign.pattern.base.sheet, shifts_mm, sheets.key(0).name());
  FoldingModel model(campaign.pattern, campaign.sampling(), sheets.design);
  const solver::Sheet sheet = model.sheet(shifts_mm, sheets.key(0).name());
  if (sheet.panels().facets.size() > kMostPanels) {
    throw schema::UserError(
        schema::Cause::bad_request,
        call.path + ": too large (joint gaps of an overconstrained sheet are found for at most " +
            std::to_string(kMostPanels) + " panels, and this one has " +
            std::to_string(sheet.panels().facets.size()) + "); take a part of it");
  }
  const auto from_deg = call.from_deg ? call.from_deg : sheets.design.from_deg;
  const double up_to_deg = from_deg.value_or(sheet.deploys_from_deg());
  const std::vector<Eigen::Index> rows = rows_up_to(sheet, up_to_deg);
  if (rows.empty() || up_to_deg > sheet.deploys_from_deg()) {
    throw schema::UserError(
        solver::beyond_d_fault(sheet.name(), up_to_deg, sheet.deploys_from_deg()));
  }
  const LongWork work("tolerance is under way", work_style(), false);
  std::vector<Eigen::Matrix2Xd> errors_mm(call.study.trials, shifts_mm);
  for (std::uint64_t trial = 0; trial < call.study.trials; ++trial) {
    trial_errors(campaign, *call.amplitude_mm, trial, errors_mm[trial].data());
  }
  solver::MiscutGap gap = solver::find_miscut_gaps(sheet, errors_mm, rows);
  gap.amplitude_mm = *call.amplitude_mm;
  if (!call.json) return put(miscut_gap_text(sheet.name(), gap));
  schema::Json document = schema::miscut_gap_json(gap);
  document.update(sheets.key(0).json());
  put_json(document);
}

}  // namespace misalign::search
