// Starts half of the program: search, status and query, without what needs proofs or a sheet in
// motion.
#include "schema/files/user_error.hpp"
#include "search/ranks/process_start.hpp"
#include "search/ranks/stop_signal.hpp"
#include "search/sheets/row_certifier.hpp"
#include "search/sheets/study_functions.hpp"
#include "search/verbs/cli.hpp"

namespace misalign::search {

void certify_if_asked(DrawEvaluator& evaluator) {
  if (!evaluator.campaign().certify) return;
  throw schema::UserError(schema::Cause::failure,
                          "this is the program that scripts/run.sh builds first, which certifies "
                          "nothing; cmake --build --preset release builds the whole one");
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
