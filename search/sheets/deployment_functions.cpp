#include "search/sheets/deployment_functions.hpp"

#include <sqlite3.h>

#include <memory>
#include <optional>
#include <utility>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/files/features.hpp"
#include "search/sheets/campaign_sheet.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/terminal/long_work.hpp"
#include "solver/design/deploy.hpp"

namespace misalign::search {
namespace {

// One for all functions of a connection. The last draw is kept, since several functions usually ask
// for the same.
class DeploymentCache {
 public:
  DeploymentCache(SQLite::Database& database, std::string path)
      : database_(database), path_(std::move(path)) {}
  DeploymentCache(SQLite::Database& database, const schema::Campaign& campaign, FoldingModel& model)
      : database_(database), campaign_(&campaign), model_(&model) {}

  const std::optional<solver::DeploymentStudy>& study(std::uint64_t draw,
                                                      std::optional<double> from_deg) {
    if (!model_) make_model();
    if (draw_ == draw && from_deg_ == from_deg) return study_;
    if (draw_ != draw) {
      show_work("sheets let go", sheets_++);
      sheet_.emplace(model_->sheet(shifts_of_number(database_, *campaign_, draw)));
    }
    draw_ = draw;
    from_deg_ = from_deg;
    solver::DeployOptions options = deploy_options(model_->design(), *sheet_);
    if (from_deg) options.from_deg = from_deg;
    // A candidate's D is not less than the threshold: mostly that is known to be enough.
    if (campaign_->threshold_deg >= solver::kDeployFrom_deg && !options.from_deg &&
        is_candidate(draw)) {
      options.from_deg = solver::kDeployFrom_deg;
    }
    study_ = solver::deploy(*sheet_, options).study;
    return study_;
  }

 private:
  bool is_candidate(std::uint64_t draw) {
    // None that outlives the call: the connection must be able to close.
    SQLite::Statement candidate(database_, "SELECT 1 FROM candidate WHERE draw = ?");
    candidate.bind(1, static_cast<std::int64_t>(draw));
    return candidate.executeStep();
  }

  void make_model() {
    own_campaign_ = schema::read_campaign_of(database_, path_);
    own_model_ = std::make_unique<FoldingModel>(*own_campaign_);
    campaign_ = &*own_campaign_;
    model_ = own_model_.get();
  }

  SQLite::Database& database_;
  const std::string path_;
  std::optional<schema::Campaign> own_campaign_;
  std::unique_ptr<FoldingModel> own_model_;
  const schema::Campaign* campaign_ = nullptr;
  FoldingModel* model_ = nullptr;
  std::optional<solver::Sheet> sheet_;
  std::optional<double> from_deg_;
  std::optional<std::uint64_t> draw_;
  std::uint64_t sheets_ = 0;
  std::optional<solver::DeploymentStudy> study_;
};

using Number = std::optional<double> (*)(const solver::DeploymentStudy&);

struct Function {
  std::shared_ptr<DeploymentCache> cache;
  Number number;
};

void call(sqlite3_context* context, int count, sqlite3_value** values) {
  if constexpr (!has("SUNDIALS")) {
    sqlite3_result_error(context, schema::missing_text("SUNDIALS").c_str(), -1);
    return sqlite3_result_error_code(context, SQLITE_ABORT);
  }
  const auto& function = *static_cast<const Function*>(sqlite3_user_data(context));
  const bool has_angle = count > 1 && sqlite3_value_numeric_type(values[1]) != SQLITE_NULL;
  const double from_deg = has_angle ? sqlite3_value_double(values[1]) : solver::kDeployFrom_deg;
  if (sqlite3_value_numeric_type(values[0]) != SQLITE_INTEGER ||
      sqlite3_value_int64(values[0]) < 0 || !(from_deg > 0 && from_deg <= 180)) {
    return sqlite3_result_null(context);
  }
  try {
    const auto& study =
        function.cache->study(static_cast<std::uint64_t>(sqlite3_value_int64(values[0])),
                              has_angle ? std::optional(from_deg) : std::nullopt);
    const auto number = study ? function.number(*study) : std::nullopt;
    number ? sqlite3_result_double(context, *number) : sqlite3_result_null(context);
  } catch (const std::exception& error) {
    sqlite3_result_error(context, error.what(), -1);
  }
}

void forget(void* function) { delete static_cast<Function*>(function); }

void add(SQLite::Database& database, const std::shared_ptr<DeploymentCache>& cache) {
  const auto add_one = [&](const char* name, Number number) {
    for (const int count : {1, 2}) {
      sqlite3_create_function_v2(database.getHandle(), name, count,
                                 SQLITE_UTF8 | SQLITE_DETERMINISTIC, new Function{cache, number},
                                 call, nullptr, nullptr, forget);
    }
  };
  add_one("deploy_time_s",
          [](const solver::DeploymentStudy& study) { return study.deploy_time_s(); });
  add_one("critical_friction_n_mm_per_mm",
          [](const solver::DeploymentStudy& study) { return study.friction.critical_n_mm_per_mm; });
}

}  // namespace

void add_deployment_functions(SQLite::Database& database, const std::string& path) {
  add(database, std::make_shared<DeploymentCache>(database, path));
}

void add_deployment_functions(SQLite::Database& database, const schema::Campaign& campaign,
                              FoldingModel& model) {
  add(database, std::make_shared<DeploymentCache>(database, campaign, model));
}

}  // namespace misalign::search
