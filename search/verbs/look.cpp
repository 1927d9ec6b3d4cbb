#include "search/verbs/look.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "schema/catalogue/catalogue_state.hpp"
#include "search/draws/trial.hpp"
#include "search/terminal/folding_text.hpp"
#include "search/terminal/terminal.hpp"
#include "solver/linear/mobility.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::search {
namespace {

using schema::Json;

void print_folding(const schema::FoldingView& view, bool table) {
  const std::string text = folding_text(
      view, {terminal_width(STDOUT_FILENO), locale_is_utf8(), table, paint_for(STDOUT_FILENO)});
  put(text);
}

// A set of holes and what the Jacobian says of it.
struct Perforation {
  std::vector<int> holes;
  solver::Mobility mobility;
};

// Every perforation that counts to one degree of freedom.
std::vector<Perforation> perforations_of(const schema::Pattern& pattern, const std::string& path) {
  constexpr std::size_t kMostPerforations = 2000;
  const solver::CreasePattern& sheet = pattern.base.sheet;
  const auto sets =
      solver::separate_facets(sheet, solver::holes_that_count_to_one(sheet), kMostPerforations);
  if (!sets) {
    throw schema::UserError(schema::kExitBadInput,
                            path + ": more than " + std::to_string(kMostPerforations) +
                                " perforations, or too many to look for, count to one degree of "
                                "freedom (the mesh is too large to list them); take a part of it");
  }
  // A pilot that no perforation takes away.
  const solver::BaseFolding& own = pattern.base.folding;
  std::vector<int> assignment = own.assignment();
  for (int& sign : assignment) sign *= own.side();
  const auto folding = std::get<solver::BaseFolding>(solver::fold_sequentially(
      sheet, assignment, solver::default_pilot(sheet, solver::inner_facets(sheet))));
  std::vector<Perforation> perforations;
  for (const std::vector<int>& holes : *sets) {
    perforations.push_back({holes, solver::measured_mobility(sheet, holes, folding)});
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

// One line each, then one about those that only count to one.
void print_perforations(const Json& one, const Json& others) {
  if (!one.empty()) put_format("%8s %9s %4s  holes\n", "unknowns", "equations", "rank");
  for (const Json& row : one) {
    put_format("%8d %9d %4d  %s\n", row["unknowns"].get<int>(), row["equations"].get<int>(),
               row["rank"].get<int>(), row["holes"].dump().c_str());
  }
  std::map<std::pair<int, int>, int> by_rank;
  for (const Json& row : others) {
    ++by_rank[{row["rank"].get<int>(), row["equations"].get<int>()}];
  }
  std::string ranks;
  for (const auto& [rank, times] : by_rank) {
    ranks += (ranks.empty() ? "" : ", ") + std::to_string(times) + " of rank " +
             std::to_string(rank.first) + " with " + std::to_string(rank.second) + " equations";
  }
  put_format("%zu %s one degree of freedom; %zu more count to 1 by (2.1) but are not 1%s%s\n",
             one.size(), one.size() == 1 ? "leaves" : "leave", others.size(),
             ranks.empty() ? "" : ": ", ranks.c_str());
}

}  // namespace

void fold(const FoldOptions& options) {
  const auto [pattern, sampling, exported] =
      schema::read_sampled_pattern_file(options.pattern_path);
  solver::PathPlanOptions path;
  path.sample_deg = sampling.sample_deg;
  path.end_deg =
      std::min(options.to_deg.value_or(sampling.end_deg), pattern.base.folding.end_deg());
  path.look_deg = options.step_deg;
  const solver::Model model(pattern.base, path, sampling.between_samples);
  const auto history = solver::record_history(model, pattern.vertices_mm());
  const schema::FoldingView view{pattern, pattern.shifts_mm, model.mechanism(), history,
                                 sampling.sample_deg};
  options.json ? put_json(schema::folding_json(view)) : print_folding(view, options.table);
}

void list_perforations(const PerforationsOptions& options) {
  const schema::Pattern pattern =
      schema::read_pattern_file(options.pattern_path, schema::Perforations::any);
  Json one = Json::array(), others = Json::array();
  for (const Perforation& perforation : perforations_of(pattern, options.pattern_path)) {
    (perforation.mobility.is_one() ? one : others)
        .push_back(perforation_json(pattern, perforation));
  }
  if (options.json) {
    put_json({{"perforations", one}, {"count_to_one_only", others}});
  } else {
    print_perforations(one, others);
  }
}

void replay(const ReplayOptions& options) {
  const auto database = schema::open_for_reading(options.catalogue_path);
  Trial trial(schema::read_campaign_of(*database, options.catalogue_path));
  const schema::Campaign& campaign = trial.campaign();
  const auto history = trial.history(options.draw);
  const Eigen::Matrix2Xd shifts_mm = trial.shifts_mm(options.draw);
  const schema::FoldingView view{campaign.pattern, shifts_mm, trial.mechanism(), history,
                                 campaign.sample_deg};
  const bool accepted = campaign.accepts(history.verdict);
  if (!options.json) {
    const Paint paint = paint_for(STDOUT_FILENO);
    put_format("draw %llu of %s: %s\n", static_cast<unsigned long long>(options.draw),
               campaign.name.c_str(),
               (accepted ? paint.good("accepted") : paint.bad("not accepted")).c_str());
    print_folding(view, options.table);
    return;
  }
  Json json = schema::folding_json(view);
  json["campaign"] = {{"name", campaign.name}, {"identity", schema::identity(campaign)}};
  json["draw"] = options.draw;
  json["verdict"]["accepted"] = accepted;
  put_json(json);
}

}  // namespace misalign::search
