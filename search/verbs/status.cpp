// `misalign status`: progress and results of a campaign.
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "schema/catalogue/campaign_check.hpp"
#include "schema/catalogue/recovery.hpp"
#include "schema/catalogue/write_ahead_log.hpp"
#include "search/terminal/nothing_found.hpp"
#include "search/terminal/shell_word.hpp"
#include "search/terminal/status_text.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/border.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct StatusCall {
  std::string path;
  bool json = false, check = false, recover = false;
  std::optional<double> at_deg;
};

// Returns whether the last run still works elsewhere, or was killed.
bool last_run_has_no_end(SQLite::Database& database) {
  return schema::reading(database, [&] {
    SQLite::Statement run(database, "SELECT ended_at IS NULL FROM run ORDER BY id DESC LIMIT 1");
    return run.executeStep() && run.getColumn(0).getInt() == 1;
  });
}

int show_status(const StatusCall& call) {
  if (call.recover) schema::recover(call.path);
  const bool lacks_log = schema::lacks_log(call.path);
  const auto database = schema::open_for_reading(call.path);
  std::optional<SQLite::Transaction> moment;
  schema::reading(*database, [&] { moment.emplace(*database); });
  const schema::CatalogueState state = schema::read_state(*database);
  const auto goal_fault =
      schema::reading(*database, [&] { return schema::goal_fault(*database, state); });
  std::optional<schema::DeployingFrom> deploying;
  if (call.at_deg) {
    const schema::Campaign campaign = schema::read_campaign_of(*database, call.path);
    deploying = deploying_from(*database, state, campaign, *call.at_deg);
  }
  const schema::Survival survival = schema::read_survival(*database);
  if (call.json) {
    schema::Json answer = schema::status_json(state);
    answer["survival"] = survival_json(survival, state);
    if (deploying) answer["at"] = schema::deploying_json(*deploying, state);
    put_json(answer);
  } else {
    put(status_text(state, deploying, paint_for(STDOUT_FILENO)));
    for (const std::string& sentence : nothing_found(survival, state)) {
      put("\n" + schema::printable(sentence) + "\n");
    }
    std::fflush(stdout);
    if (!call.check) spdlog::info("next: {}", next_step(state, call.path, ""));
  }
  if (lacks_log && last_run_has_no_end(*database)) {
    const std::string path = shell_word(call.path);
    spdlog::warn(
        "{0}: its last run has no end, and its log, {0}-wal, is missing; a copy that was made of "
        "the file alone while a search was writing lacks what was in the log: copy again with "
        "misalign merge COPY.db ORIGINAL.db",
        path);
  }
  if (goal_fault) {
    spdlog::error(
        "{}: {} (another program changed it), so that complete and missing say nothing; the next "
        "search of this campaign repairs it",
        call.path, goal_fault->sentence);
  }
  if (!call.check) return 0;
  if (goal_fault) return exit_code_of(schema::Cause::check_failed);
  return state.gaps.empty() ? 0 : kExitWorkRemains;
}

}  // namespace

Action status_verb(CLI::App& verb) {
  verb.description("progress and results of a campaign");
  verb.footer(
      "The shares of first faults, and survival in the JSON, come from the fault sample: each\n"
      "of its rows has the weight of the draws that it represents. Where nothing was accepted,\n"
      "status shows how many draws survive to which angle, an upper bound of the acceptance\n"
      "rate, and advice.\n\n"
      "Examples:\n  misalign status results/miura-6x6-1a2b3c4d.db --at 160");
  auto call = std::make_shared<StatusCall>();
  verb.add_option("CATALOGUE", call->path, "catalogue file")->required();
  verb.add_flag("--json", call->json, "as JSON");
  verb.add_flag("--check", call->check,
                "exit code 75 while work remains, 0 when complete, 6 if the goal's end is wrong");
  verb.add_flag(
      "--recover", call->recover,
      "first roll back, or merge, the files that a killed program left beside the catalogue");
  verb.add_option("--at", call->at_deg,
                  "also count the candidates that deploy from this angle, degrees")
      ->type_name("DEG");
  return [call] { return show_status(*call); };
}

}  // namespace misalign::search
