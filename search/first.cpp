// Starts half of the program: search, status and query, without what needs proofs or a sheet in
// motion.
#include "schema/files/user_error.hpp"
#include "search/ranks/process_start.hpp"
#include "search/ranks/stop_signal.hpp"
#include "search/sheets/front_query.hpp"
#include "search/sheets/optimised_draw.hpp"
#include "search/sheets/row_certifier.hpp"
#include "search/sheets/study_functions.hpp"
#include "search/verbs/cli.hpp"

namespace misalign::search {
namespace {

schema::UserError whole_program_needed(const char* it) {
  return {schema::Cause::failure,
          std::string("this is the program that scripts/run.sh builds first, which ") + it +
              "; cmake --build --preset release builds the whole one"};
}

}  // namespace

void certify_if_asked(DrawEvaluator& evaluator) {
  if (!evaluator.campaign().certify) return;
  throw whole_program_needed("certifies nothing");
}

void optimise_if_asked(DrawEvaluator& evaluator) {
  if (!evaluator.campaign().search.optimisation) return;
  throw whole_program_needed("makes no draw better");
}

void optimise_if_asked(Climber& climber) {
  if (!climber.campaign().search.optimisation) return;
  throw whole_program_needed("makes no sheet better");
}

std::string fingerprint(const schema::Campaign& /*campaign*/, const std::string& golden_verdicts) {
  return golden_verdicts;
}

std::string front_sql(SQLite::Database& /*database*/, const std::vector<std::string>& /*words*/,
                      const std::string& /*where*/) {
  throw whole_program_needed("finds no front");
}

// No sheet is studied here.
void add_study_functions(SQLite::Database& /*database*/, const std::string& /*path*/) {}
void look_ahead(SQLite::Database& /*database*/, const std::string& /*sql*/) {}

}  // namespace misalign::search

int main(int argc, char** argv) {
  using namespace misalign::search;
  prepare_process();
  watch_for_lost_pages();
  return run_command_line(argc, argv, [](const Words& typed) -> std::vector<Verb> {
    return {{"search", [&typed](CLI::App& verb) { return search_verb(verb, typed); }},
            {"status", status_verb},
            {"query", query_verb}};
  });
}
