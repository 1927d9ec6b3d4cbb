// `misalign perforations`: sets of holes that leave one degree of freedom.
#include <fmt/format.h>

#include <map>

#include "schema/pattern/pattern_file.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"
#include "solver/linear/mobility.hpp"
#include "solver/pattern/perforation.hpp"
#include "solver/sheet/followed_base.hpp"

namespace misalign::search {
namespace {

using schema::Json;

struct PerforationsCall {
  std::string pattern_path;  // its holes are ignored
  std::optional<int> holes;  // none: as many as count to one degree of freedom
  bool json = false;
};

// A set of holes and its mobility by the rank of the Jacobian.
struct Perforation {
  std::vector<int> holes;
  solver::Mobility mobility;
};

// Mobility on the path to the target of a mesh that is its own base; its rank is 0 where flat and
// target are not joined.
solver::Mobility mobility_to_target(const schema::Pattern& pattern, const std::vector<int>& holes) {
  const solver::CreasePattern& sheet = pattern.base.sheet;
  const int pilot = solver::default_pilot(sheet, holes);
  const solver::Mechanism mechanism = solver::build_mechanism(
      {sheet, holes, solver::BaseFolding(pilot, 1, std::vector<int>(sheet.edges.size(), 0))});
  const solver::Mobility none{mechanism.unknowns, mechanism.equations, 0};
  if (mechanism.unknowns != mechanism.equations + 1) return none;
  const auto found =
      solver::follow_from_target(sheet, holes, pilot, pattern.folded_target->vertices_mm);
  const auto* const base = std::get_if<solver::FollowedBase>(&found);
  return base ? solver::measured_mobility(sheet, holes, base->folding) : none;
}

// Lists every perforation with this number of holes.
std::vector<Perforation> perforations_of(const schema::Pattern& pattern, const std::string& path,
                                         int holes) {
  constexpr std::size_t kMostPerforations = 2000;
  const solver::CreasePattern& sheet = pattern.base.sheet;
  const auto sets = solver::separate_facets(sheet, holes, kMostPerforations);
  if (!sets) {
    throw schema::UserError(schema::Cause::bad_input,
                            path + ": more than " + std::to_string(kMostPerforations) +
                                " perforations, or too many to look for, have " +
                                std::to_string(holes) +
                                " holes (the mesh is too large to list them); take a part of it");
  }
  const solver::BaseFolding& base = pattern.base.folding;
  std::vector<Perforation> perforations;
  if (base.path()) {
    for (const std::vector<int>& set : *sets) {
      perforations.push_back({set, mobility_to_target(pattern, set)});
    }
    return perforations;
  }
  // The pilot is one that no perforation takes away.
  std::vector<int> assignment = base.assignment();
  for (int& sign : assignment) sign *= base.side();
  const auto folding = std::get<solver::BaseFolding>(solver::fold_sequentially(
      sheet, assignment, solver::default_pilot(sheet, solver::inner_facets(sheet))));
  for (const std::vector<int>& set : *sets) {
    perforations.push_back({set, solver::measured_mobility(sheet, set, folding)});
  }
  return perforations;
}

Json perforation_json(const schema::Pattern& pattern, const Perforation& perforation) {
  Json holes = Json::array();
  for (const int f : perforation.holes) holes.push_back(schema::facet_json(pattern, f));
  return {{"holes", holes},
          {"unknowns", perforation.mobility.unknowns},
          {"equations", perforation.mobility.equations},
          {"rank", perforation.mobility.rank},
          {"degrees_of_freedom", perforation.mobility.degrees_of_freedom()}};
}

void print_sets(const Json& sets) {
  if (!sets.empty()) put("unknowns equations rank  holes\n");
  for (const Json& row : sets) {
    put("{:8} {:9} {:4}  {}\n", row["unknowns"].get<int>(), row["equations"].get<int>(),
        row["rank"].get<int>(), row["holes"].dump());
  }
}

// Prints a line each, then one about those that only count to one.
void print_perforations(const Json& mobile, const Json& others) {
  print_sets(mobile);
  std::map<std::pair<int, int>, int> by_rank;
  for (const Json& row : others) {
    ++by_rank[{row["rank"].get<int>(), row["equations"].get<int>()}];
  }
  std::vector<std::string> ranks;
  for (const auto& [rank, times] : by_rank) {
    ranks.push_back(fmt::format("{} of rank {} with {} equations", times, rank.first, rank.second));
  }
  put("{} {} one degree of freedom; {} more count to 1 by (2.1) but are not 1{}{}\n", mobile.size(),
      mobile.size() == 1 ? "leaves" : "leave", others.size(), ranks.empty() ? "" : ": ",
      fmt::join(ranks, ", "));
}

void list_perforations(const PerforationsCall& call) {
  const schema::Pattern pattern =
      schema::read_pattern_file(call.pattern_path, schema::Perforations::any);
  say_reading(call.pattern_path, pattern);
  const int usual = solver::holes_that_count_to_one(pattern.base.sheet);
  const int holes = call.holes.value_or(usual);
  Json mobile = Json::array(), others = Json::array();
  for (const Perforation& perforation : perforations_of(pattern, call.pattern_path, holes)) {
    const bool is_one = holes == usual ? perforation.mobility.is_one()
                                       : perforation.mobility.degrees_of_freedom() == 1;
    (is_one ? mobile : others).push_back(perforation_json(pattern, perforation));
  }
  if (call.json) {
    put_json(
        {{"perforations", mobile}, {"count_to_one_only", holes == usual ? others : Json::array()}});
  } else if (holes == usual) {
    print_perforations(mobile, others);
  } else {
    print_sets(mobile);
    put("{} of {} sets of {} leave one degree of freedom on the base's path{}\n", mobile.size(),
        mobile.size() + others.size(), holes,
        holes < usual ? "; with more equations than unknowns only shifts such as those of "
                        "`misalign construct` fold"
                      : "");
  }
}

}  // namespace

Action perforations_verb(CLI::App& verb) {
  verb.description("list the holes that leave one degree of freedom");
  verb.footer(
      "Lists every set of inner panels, no two sharing an edge, that counts to one\n"
      "degree of freedom and has one by the rank of the Jacobian. The pattern's own\n"
      "holes do not matter. With fewer holes (--holes) sheets have more equations than\n"
      "unknowns: those listed fold where the shifts keep creases' directions and holes\n"
      "parallelograms, as `misalign construct` makes them.\n\n"
      "Examples:\n  misalign perforations search/patterns/turned-quads-6x6.json\n"
      "  misalign perforations search/patterns/table1.json --holes 2");
  auto call = std::make_shared<PerforationsCall>();
  verb.add_option("PATTERN", call->pattern_path, "pattern file (JSON)")->required();
  add_value(verb, "--holes", call->holes,
            "number of holes of each set [what counts to one degree of freedom]",
            counted(1, 1000000), "N");
  verb.add_flag("--json", call->json, "as JSON");
  return showing(call, list_perforations);
}

}  // namespace misalign::search
