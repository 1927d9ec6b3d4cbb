// `misalign merge`: catalogues of one campaign into one.
#include "search/checks/merge.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "schema/catalogue/catalogue_state.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/ranks/run_info.hpp"
#include "search/terminal/terminal.hpp"
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
    return schema::kExitCheckFailed;
  }
  const auto merged = schema::open_for_reading(options.output);
  const schema::CatalogueState state = schema::read_state(*merged);
  put("{}: {} catalogues, {} units taken, {} draws compared, {} computed again, {} decided; {} "
      "draws, {} accepted, digest {}\n",
      schema::printable(options.output), options.inputs.size(), report.units, report.compared,
      report.recomputed, report.decided, state.draws_in_ledger, state.accepted, state.digest);
  return 0;
}

}  // namespace

Action merge_verb(CLI::App& verb) {
  verb.description("catalogues of one campaign into one");
  verb.footer(
      "Draws that several of them have are compared (displacements and samples\n"
      "exactly, metrics within the tolerances of verify) and counted once; parts of\n"
      "units that overlap others are computed again. Exit code 6, and no file, if\n"
      "anything differs.\n\n"
      "Examples:\n  misalign merge all.db part-1.db part-2.db");
  auto options = std::make_shared<MergeOptions>();
  verb.add_option("OUT", options->output, "catalogue file to write; must not exist")->required();
  verb.add_option("IN", options->inputs, "catalogue files, read only")->required();
  verb.add_flag_callback(
      "--allow-mixed-builds", [options] { options->builds = schema::Builds::mixed; },
      "go on although builds with other golden verdicts wrote them");
  return [options] { return merge_catalogues(*options); };
}

}  // namespace misalign::search
