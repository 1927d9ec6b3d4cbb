// `misalign report`: one page about a catalogue, or a pattern.
#include "schema/report/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <limits>

#include "schema/catalogue/study_table.hpp"
#include "schema/files/features.hpp"
#include "schema/files/output_file.hpp"
#include "search/report/report_data.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/choice_options.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/rank_options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

// A draw in detail takes some 0.1 MB of the page, of a large sheet 0.4 MB.
constexpr std::uint64_t kMostDetails = 1000;

// A row has some 320 bytes of the page. Chromium takes three seconds for 100,000, and half a minute
// and half a gigabyte for a million (results/report).
constexpr std::uint64_t kMostRows = 250000;

CLI::Validator as_many_as_browsers_show() {
  return CLI::Validator(
      [number = counted(0, std::numeric_limits<std::int64_t>::max())](std::string& text) {
        const std::string fault = number(text);
        if (!fault.empty() || std::stoull(text) <= kMostRows) return fault;
        return fmt::format(
            "{} rows would be a page that browsers hardly show (at most {}, 80 MB); for more ask "
            "`misalign query` with --csv",
            text, kMostRows);
      },
      "");
}

void refuse_own_input(const ReportCall& call) {
  std::vector<std::string> read = call.detail.stress_files;
  read.push_back(call.path);
  if (!call.beside.empty()) read.push_back(call.beside);
  for (const std::string& path : read) {
    std::error_code error;
    if (!std::filesystem::equivalent(call.output, path, error)) continue;
    throw schema::UserError(schema::Cause::bad_request,
                            "--output " + call.output + ": is the input file; name another file");
  }
}

// The page of a pattern file shows that one sheet.
void refuse_choice_of_candidates(const ReportCall& call, const CLI::App& verb,
                                 const CLI::App& group) {
  std::string chosen_by = first_given(group);
  for (const char* option : {"--draw", "--rows", "--details", "--by", "--column", "--beside"}) {
    if (verb.count(option) > 0) chosen_by = option;
  }
  for (const schema::StudyEntry& study : schema::study_table()) {  // of candidates alone
    const auto asked = call.studies.find(study.name);
    if (study.has_columns_in_report() && asked != call.studies.end() && asked->second) {
      chosen_by = fmt::format("--{}", study.name);
    }
  }
  if (!chosen_by.empty()) throw only_of_a_catalogue(call.path, chosen_by);
}

void check_output(const ReportCall& call, bool json) {
  if (json == call.output.empty()) return;
  throw schema::UserError(schema::Cause::bad_request,
                          json ? "--json has no meaning with --output (it writes to standard "
                                 "output); take one of them out"
                               : "--output is required");
}

void write(const ReportCall& call, const schema::Json& data) {
  if (call.output.empty()) return put_json(data);
  schema::write_text_file(call.output, schema::report_page(data));
  put(schema::printable(call.output) + "\n");
}

int show_report(ReportCall& call, bool json, const CLI::App& verb, const CLI::App& group) {
  check_output(call, json);
  if (!json) schema::need("Node.js");
  if (call.studies["deploy"]) schema::need("SUNDIALS");
  call.detail.contact = call.studies["contact"];
  if (!has("SUNDIALS")) {
    spdlog::warn("no deployment is in the page: {}", schema::missing_text("SUNDIALS"));
  }
  if (is_pattern_file(call.path)) {
    refuse_choice_of_candidates(call, verb, group);
    refuse_own_input(call);
    write(call, report_of_pattern(call));
    return 0;
  }
  if (call.choice.where.empty()) check_by(call.choice);
  refuse_own_input(call);
  write(call, report_of_catalogue(call));
  return 0;
}

}  // namespace

Action report_verb(CLI::App& verb) {
  verb.description("one self-contained page of a catalogue or pattern");
  verb.footer(
      "The page needs no network. Its table holds the best candidates. Some are shown in detail\n"
      "(crease pattern, folding, histories, springs): the 36 best, or those that you choose, and\n"
      "every --draw. The page of a pattern file shows that one sheet.\n"
      "Needs a program built with Node.js (misalign --version).\n\n"
      "Examples:\n  misalign report results/miura-6x6-1a2b3c4d.db --output report.html\n"
      "  misalign report results/miura-6x6-1a2b3c4d.db --draw 1234 --output report.html\n"
      "  misalign report results/miura-6x6-1a2b3c4d.db --diverse 12 \\\n"
      "    --where \"stroke_max < 0.08\" --output report.html\n"
      "  misalign report results/miura-6x6-1a2b3c4d.db --draw 1234 --contact \\\n"
      "    --stress stress/miura-6x6-1234-stress.json --output report.html\n"
      "  misalign report results/miura-6x6-1a2b3c4d.db \\\n"
      "    --beside results/miura-8x8-5e6f7a8b.db --output both.html\n"
      "  misalign report search/patterns/table1.json --output table1.html");
  auto call = std::make_shared<ReportCall>();
  auto json = std::make_shared<bool>(false);
  add_catalogue_or_pattern(verb, call->path);
  verb.add_option("--output", call->output, "HTML file to write")->type_name("FILE");
  verb.add_flag("--json", *json, "the page's data as JSON, instead of the page");
  add_draws(verb, call->draws,
            "also this draw, accepted or not; of a splitting search only a stored one");
  add_value(verb, "--rows", call->rows,
            "largest number of candidates in the table, at most 250000 [10000]",
            as_many_as_browsers_show(), "N");
  auto* details = add_value(verb, "--details", call->details,
                            "number of the best, or of those of --where, shown in detail [36]",
                            counted(0, kMostDetails), "N");
  auto* group = verb.add_option_group("choice", "which candidates are shown in detail");
  const ChoiceOptions chosen = add_choice(verb, *group, call->choice);
  for (CLI::Option* many : {chosen.best, chosen.diverse}) {
    many->check(counted(1, kMostDetails))->excludes(details);
  }
  add_from(verb, call->design.from_deg, "[the design's, or 36 for release and D for contact]");
  add_springs(verb, call->design);
  add_fill(verb, call->design);
  for (const schema::StudyEntry& study : schema::study_table()) {
    if (study.in_report) {
      verb.add_flag(fmt::format("--{}", study.name), call->studies[study.name], study.in_report);
    }
  }
  verb.add_option("--column", call->columns,
                  "also this number of each candidate in the table: " +
                      fmt::format("{}", fmt::join(schema::study_functions(), ", ")) +
                      " (may be repeated)")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("NAME");
  verb.add_option("--beside", call->beside,
                  "another catalogue, of no splitting search: the overview compares both campaigns")
      ->type_name("CATALOGUE");
  verb.add_option(
          "--stress", call->detail.stress_files,
          "NAME-stress.json that `misalign stress` wrote of a sheet shown in detail: colours "
          "its panels (may be repeated)")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("FILE");
  add_jobs(verb);
  return [call, json, &verb, group] { return show_report(*call, *json, verb, *group); };
}

}  // namespace misalign::search
