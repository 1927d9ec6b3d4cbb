// The verbs of the command line: each in a file of its name, with its options, help and action.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "search/draws/parts.hpp"

namespace misalign::search {

/// The action of a verb, which owns its options: returns the exit code; throws UserError.
using Action = std::function<int()>;

/// An action that shows something of a call and ends well.
template <class Call, class Show>
Action showing(const std::shared_ptr<Call>& call, Show show) {
  return [call, show] {
    show(*call);
    return 0;
  };
}

/// The typed words, the program's name first.
using Words = std::vector<std::string>;

// Each describes its verb and adds its options.
Action actuators_verb(CLI::App& verb);
Action bench_verb(CLI::App& verb);
Action card_verb(CLI::App& verb);
Action certify_verb(CLI::App& verb, const Words& typed);
Action completion_verb(CLI::App& verb);
Action config_verb(CLI::App& verb);
Action construct_verb(CLI::App& verb);
Action optimise_verb(CLI::App& verb);
Action contact_verb(CLI::App& verb);
Action deploy_verb(CLI::App& verb);
Action design_verb(CLI::App& verb);
Action doctor_verb(CLI::App& verb);
Action export_verb(CLI::App& verb);
Action fold_verb(CLI::App& verb);
Action help_verb(CLI::App& verb);
Action merge_verb(CLI::App& verb);
Action perforations_verb(CLI::App& verb);
Action query_verb(CLI::App& verb, const Parts& parts);
Action replay_verb(CLI::App& verb);
Action report_verb(CLI::App& verb);
Action search_verb(CLI::App& verb, const Words& typed, const Parts& parts);
Action shape_verb(CLI::App& verb);
Action status_verb(CLI::App& verb);
Action stress_verb(CLI::App& verb);
Action tolerance_verb(CLI::App& verb);
Action verify_verb(CLI::App& verb);
Action watch_verb(CLI::App& verb);

struct Verb {
  const char* name;
  std::function<Action(CLI::App&)> set_up;
};

/// The verbs that need no part.
inline std::vector<Verb> first_verbs(const Words& typed, const Parts& parts) {
  return {{"search", [&](CLI::App& verb) { return search_verb(verb, typed, parts); }},
          {"status", status_verb},
          {"query", [&](CLI::App& verb) { return query_verb(verb, parts); }}};
}

/// All verbs, in the order of --help; help comes last, since it lists the others.
inline std::vector<Verb> all_verbs(const Words& typed, const Parts& parts) {
  return {{"search", [&](CLI::App& verb) { return search_verb(verb, typed, parts); }},
          {"status", status_verb},
          {"fold", fold_verb},
          {"perforations", perforations_verb},
          {"construct", construct_verb},
          {"optimise", optimise_verb},
          {"shape", shape_verb},
          {"design", design_verb},
          {"replay", replay_verb},
          {"query", [&](CLI::App& verb) { return query_verb(verb, parts); }},
          {"export", export_verb},
          {"verify", verify_verb},
          {"certify", [&](CLI::App& verb) { return certify_verb(verb, typed); }},
          {"merge", merge_verb},
          {"config", config_verb},
          {"tolerance", tolerance_verb},
          {"doctor", doctor_verb},
          {"actuators", actuators_verb},
          {"contact", contact_verb},
          {"deploy", deploy_verb},
          {"stress", stress_verb},
          {"card", card_verb},
          {"report", report_verb},
          {"watch", watch_verb},
          {"bench", bench_verb},
          {"completion", completion_verb},
          {"help", help_verb}};
}

}  // namespace misalign::search
