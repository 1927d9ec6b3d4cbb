#include "search/checks/merge.hpp"

#include <algorithm>
#include <iterator>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/candidate_row.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/ends_state.hpp"
#include "schema/catalogue/merge_plan.hpp"
#include "schema/catalogue/population_rows.hpp"
#include "schema/files/output_file.hpp"
#include "search/checks/column_tolerances.hpp"
#include "search/checks/draws_again.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/draws/golden_verdicts.hpp"
#include "search/sheets/whole_program.hpp"

namespace misalign::search {
namespace {

using schema::DrawRange;
using schema::Finding;
using schema::Json;

struct Input {
  std::string path;
  std::unique_ptr<SQLite::Database> database;
  std::unique_ptr<SQLite::Transaction> moment;  // one state, whoever writes meanwhile
  schema::CatalogueState state;
  std::vector<DrawRange> units;
};

// Returns the smallest goal that includes all; limits that they do not share are left out.
schema::Goal goal_of(const std::vector<Input>& inputs) {
  const schema::Goal& first = inputs.front().state.goal;
  schema::Goal goal = first;
  bool same = true;
  std::uint64_t end = 0;
  for (const Input& input : inputs) {
    const schema::Goal& other = input.state.goal;
    same = same && other == first;
    goal.range.lo = std::min(goal.range.lo, other.range.lo);
    end = std::max(end, other.planned_end());
    if (other.accepted != first.accepted) goal.accepted.reset();
    if (other.relative_error != first.relative_error) goal.relative_error.reset();
  }
  if (same) return first;
  goal.range.hi = end;
  goal.draws.reset();
  return goal;
}

class Merge {
 public:
  explicit Merge(const MergeOptions& options) : options_(options) {}

  MergeReport run() {
    schema::OutputFile file = schema::OutputFile::database(options_.output, options_.inputs);
    for (const std::string& path : options_.inputs) open(path);
    if (!report_.findings.empty()) return report_;
    std::vector<std::vector<DrawRange>> ledgers;
    for (const Input& input : inputs_) ledgers.push_back(input.units);
    plan_ = schema::plan_merge(ledgers);
    write(file.path());
    if (report_.findings.empty()) file.publish();
    return report_;
  }

 private:
  void open(const std::string& path) {
    Input input{path, schema::open_for_reading(path), {}, {}, {}};
    schema::reading(*input.database,
                    [&] { input.moment = std::make_unique<SQLite::Transaction>(*input.database); });
    schema::Campaign campaign = schema::read_campaign_of(*input.database, path);
    schema::CheckedLedger checked = schema::read_checked(*input.database, campaign);
    for (Finding& finding : checked.findings) {
      finding.sentence = path + ": " + finding.sentence;
      report_.findings.push_back(std::move(finding));
    }
    if (!checked.findings.empty()) return;
    input.state = std::move(*checked.state);  // present, since there is no finding
    input.units = schema::units_done(*input.database);
    if (!evaluator_) {
      if (campaign.search.splitting) campaign.stop.accepted = least_kept();
      evaluator_.emplace(std::move(campaign), solver::available_instruction_sets().back(),
                         kWithoutProofs);
    } else if (input.state.identity != inputs_.front().state.identity) {
      throw schema::UserError(schema::Cause::foreign,
                              path + ": holds another campaign than " + inputs_.front().path +
                                  " (which differs in " +
                                  schema::differences(evaluator_->campaign(), campaign) +
                                  "); join catalogues of one campaign");
    }
    inputs_.push_back(std::move(input));
  }

  void write(const std::string& path) {
    schema::Catalogue catalogue(path, evaluator_->campaign(), evaluator_->mechanism());
    for (std::size_t k = 0; k < inputs_.size(); ++k) {
      catalogue.take_over(*inputs_[k].database, plan_.kept[k]);
      report_.units += plan_.kept[k].size();
    }
    schema::RunInfo run = options_.run;
    run.golden_verdicts = fingerprint(evaluator_->campaign(), run.golden_verdicts, kWithoutProofs);
    catalogue.begin_run(run, goal_of(inputs_), options_.builds);
    for (const DrawRange& range : plan_.recomputed) {
      for (std::uint64_t next = range.lo; next < range.hi;) {
        UnitWork work(*evaluator_, {next, range.hi});
        while (!work.finished() && !work.is_full()) work.run_next_block();
        schema::UnitRecord unit = work.take();
        next = unit.range.hi;
        catalogue.commit({std::move(unit)});
      }
      report_.recomputed += range.size();
    }
    auto merged = schema::open_for_reading(path);
    for (std::size_t k = 0; k < inputs_.size(); ++k) {
      for (const DrawRange& range : plan_.compared[k]) {
        if (evaluator_->campaign().search.splitting) {
          compare_populations(*merged, inputs_[k], range);
        } else {
          decide(catalogue, *merged, inputs_[k], range);
          compare(*merged, inputs_[k], range);
        }
        report_.compared += range.size();
      }
    }
    merged.reset();
    for (const Input& input : inputs_) {
      catalogue.take_over_yields(*input.database);
      report_.faulty_certificates += catalogue.take_over_certificates(*input.database);
    }
    catalogue.end_run("merged");
    const auto wrong =
        schema::check_ledger(*schema::open_for_reading(path), evaluator_->campaign());
    report_.findings.insert(report_.findings.end(), wrong.begin(), wrong.end());
  }

  // Judges again the draws that are undecided in the merged catalogue and decided in this one.
  void decide(schema::Catalogue& catalogue, SQLite::Database& merged, const Input& input,
              const DrawRange& range) {
    const auto open = schema::draws_of(merged, "undecided", range);
    const auto open_there = schema::draws_of(*input.database, "undecided", range);
    std::vector<std::uint64_t> decided_there;
    std::set_difference(open.begin(), open.end(), open_there.begin(), open_there.end(),
                        std::back_inserter(decided_there));
    for (const std::uint64_t draw : decided_there) {
      const schema::UnitRecord unit = judge_again(*evaluator_, draw);
      if (!unit.undecided.empty()) continue;
      catalogue.settle(unit);
      ++report_.decided;
    }
  }

  void compare(SQLite::Database& merged, const Input& input, const DrawRange& range) {
    const auto open = schema::draws_of(merged, "undecided", range);
    const auto open_there = schema::draws_of(*input.database, "undecided", range);
    const auto is_open = [&](std::uint64_t draw) {
      return std::binary_search(open.begin(), open.end(), draw) ||
             std::binary_search(open_there.begin(), open_there.end(), draw);
    };
    const auto mine = schema::draws_of(merged, "candidate", range);
    const auto theirs = schema::draws_of(*input.database, "candidate", range);
    std::vector<std::uint64_t> all;
    std::set_union(mine.begin(), mine.end(), theirs.begin(), theirs.end(), std::back_inserter(all));
    for (const std::uint64_t draw : all) {
      if (is_open(draw)) continue;
      const bool is_mine = std::binary_search(mine.begin(), mine.end(), draw);
      const bool is_theirs = std::binary_search(theirs.begin(), theirs.end(), draw);
      if (is_mine && is_theirs) {
        compare_candidates(merged, input, draw);
      } else {
        differ(input, draw, "verdict", is_theirs ? "accepted" : "rejected",
               is_mine ? "accepted" : "rejected");
      }
    }
    compare_fault_samples(merged, input, range, is_open);
  }

  // Compares levels and optima alone: the sheets that a population keeps depend on the other
  // populations, which may have met them first.
  void compare_populations(SQLite::Database& merged, const Input& input, const DrawRange& range) {
    const auto levels_of = [&](SQLite::Database& database) {
      return schema::reading(database, [&] { return schema::read_population(database, range.lo); });
    };
    const std::string where =
        "population " + std::to_string(range.lo / schema::kNumbersOfPopulation);
    schema::each_difference(levels_of(*input.database), levels_of(merged),
                            [&](const std::string& count, const Json& theirs, const Json& mine) {
                              differ(input, where, count, theirs, mine);
                            });
    if (!evaluator_->campaign().search.optimisation) return;
    const auto theirs = schema::draws_of(*input.database, "candidate", range);
    for (const std::uint64_t draw : schema::draws_of(merged, "candidate", range)) {
      if (std::ranges::binary_search(theirs, draw)) compare_candidates(merged, input, draw);
    }
  }

  // Returns the smallest stop.accepted of the splitting campaigns: beyond it some catalogue lacks
  // sheets.
  std::optional<std::uint64_t> least_kept() const {
    std::optional<std::uint64_t> least;
    for (const std::string& path : options_.inputs) {
      const auto database = schema::open_for_reading(path);
      const auto most = schema::read_campaign_of(*database, path).stop.accepted;
      if (most) least = std::min(*most, least.value_or(*most));
    }
    return least;
  }

  void compare_candidates(SQLite::Database& merged, const Input& input, std::uint64_t draw) {
    const Json mine = schema::read_candidate(merged, draw);
    const Json theirs = schema::read_candidate(*input.database, draw);
    const int version = std::min(schema::metrics_version_of(merged, draw),
                                 schema::metrics_version_of(*input.database, draw));
    const ColumnTolerances tolerances{evaluator_->mechanism().panel_width_mm,
                                      evaluator_->campaign().sample_deg};
    for (const auto& [column, value] : mine.items()) {
      if (column == "draw" || column == "unit") continue;
      if (version < schema::metric_age(column).present) continue;  // another definition
      const Json other = theirs.value(column, Json());
      if (!tolerances.agree(column, other, value)) differ(input, draw, column, other, value);
    }
    if (!evaluator_->campaign().search.has_ends()) return;
    compare_ascents(schema::read_ascent(*input.database, draw), schema::read_ascent(merged, draw),
                    [&](const std::string& column, const Json& other, const Json& value) {
                      differ(input, draw, column, other, value);
                    });
  }

  // Compares rows that both units keep; check_ledger checks that each unit has its rows.
  template <class IsOpen>
  void compare_fault_samples(SQLite::Database& merged, const Input& input, const DrawRange& range,
                             const IsOpen& is_open) {
    const auto rows_of = [&](SQLite::Database& database) {
      return schema::reading(database, [&] {
        std::map<std::uint64_t, Json> rows;
        SQLite::Statement row = fault_sample_rows(database, range);
        while (row.executeStep()) {
          Json& values = rows[schema::draw_of(row.getColumn(0))];
          for (int k = 1; k < 5; ++k) values.push_back(schema::text_of(row.getColumn(k)));
        }
        return rows;
      });
    };
    const auto agree = [](Json other, const Json& values) {
      Json& fault = other[1];
      if (solver::may_be_one_fault(fault.get<std::string>(), values[1].get<std::string>())) {
        fault = values[1];
      }
      return other == values;
    };
    const auto mine = rows_of(merged), theirs = rows_of(*input.database);
    for (const auto& [draw, values] : mine) {
      const auto other = theirs.find(draw);
      if (is_open(draw) || other == theirs.end() || agree(other->second, values)) continue;
      differ(input, draw, "fault_sample", other->second, values);
    }
  }

  void differ(const Input& input, std::uint64_t draw, const std::string& column, const Json& theirs,
              const Json& mine) {
    differ(input, "draw " + std::to_string(draw), column, theirs, mine);
  }

  void differ(const Input& input, const std::string& where, const std::string& column,
              const Json& theirs, const Json& mine) {
    const auto shown = [](const Json& value) { return schema::shortened(value.dump(), 200); };
    report_.findings.push_back({where + ": " + column + " is " + shown(theirs) + " in " +
                                    input.path + ", but " + shown(mine) + " elsewhere",
                                {{"where", where},
                                 {"column", column},
                                 {"file", input.path},
                                 {"stored", theirs},
                                 {"elsewhere", mine}}});
  }

  const MergeOptions& options_;
  std::vector<Input> inputs_;
  std::optional<DrawEvaluator> evaluator_;
  schema::MergePlan plan_;
  MergeReport report_;
};

}  // namespace

MergeReport merge(const MergeOptions& options) { return Merge(options).run(); }

}  // namespace misalign::search
