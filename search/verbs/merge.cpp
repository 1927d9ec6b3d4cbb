// `misalign merge`: catalogues of one campaign into one.
#include "search/checks/merge.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "schema/catalogue/catalogue_state.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/draws/golden_verdicts.hpp"
#include "search/ranks/run_info.hpp"
#include "search/terminal/count_text.hpp"
#include "search/terminal/ladder_text.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/border.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

int merge_catalogues(MergeOptions options) {
  options.run = run_info(golden_verdicts(solver::available_instruction_sets().back()), 1);
  const MergeReport report = merge(options);
  for (std::size_t k = 0; k < std::min(report.findings.size(), schema::kMostListed); ++k) {
    spdlog::error("{}", report.findings[k].sentence);
  }
  if (!report.findings.empty()) {
    spdlog::error("{} findings; {} was not written", report.findings.size(), options.output);
    return exit_code_of(schema::Cause::check_failed);
  }
  if (report.faulty_certificates > 0) {
    spdlog::warn(
        "{} not taken over (changed since made; `misalign verify` names each, `misalign certify` "
        "makes it anew)",
        count_text(report.faulty_certificates, "certificate"));
  }
  const auto merged = schema::open_for_reading(options.output);
  const schema::CatalogueState state = schema::read_state(*merged);
  if (state.ladder) {
    put("{}: {} catalogues, {} populations taken, {} compared; {}, digest {}\n",
        schema::printable(options.output), options.inputs.size(), report.units,
        report.compared / schema::kNumbersOfPopulation, ladder_summary(state), state.digest);
    return 0;
  }
  put("{}: {} catalogues, {} units taken, {} draws compared, {} computed again, {} decided; {} "
      "draws, {} accepted, digest {}\n",
      schema::printable(options.output), options.inputs.size(), report.units, report.compared,
      report.recomputed, report.decided, state.draws_in_ledger, state.accepted, state.digest);
  return 0;
}

}  // namespace

Action merge_verb(CLI::App& verb) {
  verb.description("merge catalogues of one campaign into one");
  verb.footer(
      "Draws that several catalogues hold are compared (displacements and samples exactly,\n"
      "metrics within the tolerances of verify) and counted once. Where units overlap in\n"
      "part, one is kept, and what the other has beyond it is computed again. If anything\n"
      "differs, no file is written and the exit code is 6.\n\n"
      "Examples:\n  misalign merge all.db part-1.db part-2.db");
  auto options = std::make_shared<MergeOptions>();
  verb.add_option("OUT", options->output, "catalogue file to write; it must not exist yet")
      ->required();
  verb.add_option("IN", options->inputs, "catalogue files; they are only read")->required();
  verb.add_flag_callback(
      "--allow-mixed-builds", [options] { options->builds = schema::Builds::mixed; },
      "continue although their builds judge a set of known sheets differently");
  return [options] { return merge_catalogues(*options); };
}

}  // namespace misalign::search
