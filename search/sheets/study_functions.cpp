#include "search/sheets/study_functions.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/costly_terms.hpp"
#include "schema/catalogue/study_table.hpp"
#include "schema/files/features.hpp"
#include "search/sheets/campaign_sheet.hpp"
#include "search/sheets/known_numbers.hpp"
#include "search/sheets/on_threads.hpp"
#include "search/terminal/long_work.hpp"
#include "search/terminal/usable_threads.hpp"
#include "solver/motion/deploy.hpp"

namespace misalign::search {
namespace {

// Serves all functions of a connection.
class StudyFunctions {
 public:
  // The catalogue's campaign is used where none is given.
  StudyFunctions(SQLite::Database& database, std::string path, const schema::Campaign* campaign,
                 Unknown unknown)
      : database_(database), path_(std::move(path)), campaign_(campaign), unknown_(unknown) {}

  // The functions of a connection; null: it has none.
  static StudyFunctions* of(sqlite3* connection) {
    const std::lock_guard lock(mutex_);
    const auto found = all_.find(connection);
    return found == all_.end() ? nullptr : found->second;
  }
  void add() {
    const std::lock_guard lock(mutex_);
    all_[database_.getHandle()] = this;
    connection_ = database_.getHandle();
  }
  ~StudyFunctions() {
    const std::lock_guard lock(mutex_);
    const auto found = all_.find(connection_);
    if (found != all_.end() && found->second == this) all_.erase(found);
  }
  StudyFunctions(const StudyFunctions&) = delete;
  StudyFunctions& operator=(const StudyFunctions&) = delete;

  std::optional<double> number(std::size_t function, const StudyCall& call) {
    if (const auto* const known = find_known(function, call)) return *known;
    if (unknown_ == Unknown::is_null) return {};
    if (is_looking_ahead_) {
      expect(function, call);
      return {};
    }
    find_some(function, call);
    return *find_known(function, call);
  }

  // Records the calls of a statement. Without a LIMIT all of them are needed: numbers are found at
  // once, the cheapest first, since those may spare the dearer.
  void look_ahead(const std::string& sql, bool has_limit) {
    do {
      record(sql);
    } while (!has_limit && find_cheapest());
  }

 private:
  // The largest number of calls recorded at a time.
  static constexpr std::size_t kMostExpected = 100000;
  // A query that passes over more rows, or never ends, is recorded for at most kMostTurns turns of
  // kTurn instructions of SQLite's machine: some seconds.
  static constexpr int kTurn = 1000, kMostTurns = 300'000;
  // Sheets at once per thread: little is lost where a LIMIT ends the query.
  static constexpr std::size_t kAtOnce = 8;

  struct Expected {
    StudyCall call;
    WantedNumbers wanted{};
  };
  struct Piece {
    StudyCall call;
    WantedNumbers wanted;
    Eigen::Matrix2Xd shifts_mm;
    bool is_candidate;
  };

  void expect(std::size_t function, const StudyCall& call) {
    const auto [at, is_new] = place_.try_emplace(call, expected_.size());
    if (is_new) expected_.push_back({call, {}});
    expected_[at->second].wanted[function] = true;
  }

  void record(const std::string& sql) {
    expected_.clear();
    place_.clear();
    is_looking_ahead_ = true;
    turns_ = 0;
    const auto is_enough = [](void* self) {
      auto& its = *static_cast<StudyFunctions*>(self);
      return static_cast<int>(its.expected_.size() >= kMostExpected || ++its.turns_ > kMostTurns);
    };
    sqlite3_progress_handler(connection_, kTurn, is_enough, this);
    try {
      SQLite::Statement statement(database_, sql);
      while (statement.executeStep()) {
      }
    } catch (const SQLite::Exception&) {
      // The record is long enough, or the statement itself will say why not.
    }
    sqlite3_progress_handler(connection_, 0, nullptr, nullptr);
    is_looking_ahead_ = false;
  }

  static schema::Cost cost_of(std::size_t function) {
    return schema::study_column(sheet_number_names()[function])->cost;
  }

  // Keeps the wanted numbers of this cost.
  static WantedNumbers of_cost(const WantedNumbers& wanted, schema::Cost cost) {
    WantedNumbers some{};
    for (std::size_t k = 0; k < kNumberCount; ++k) some[k] = wanted[k] && cost_of(k) == cost;
    return some;
  }

  schema::Cost least_cost() const {
    schema::Cost least = schema::Cost::contact;
    for (const Expected& expected : expected_) {
      for (std::size_t k = 0; k < kNumberCount; ++k) {
        if (expected.wanted[k]) least = std::min(least, cost_of(k));
      }
    }
    return least;
  }

  // Finds the cheapest numbers of all expected calls; false if there are none.
  bool find_cheapest() {
    if (expected_.empty()) return false;
    const schema::Cost cost = least_cost();
    std::vector<Piece> pieces;
    for (const Expected& expected : expected_) {
      const WantedNumbers wanted = of_cost(expected.wanted, cost);
      if (std::ranges::find(wanted, true) != wanted.end()) {
        pieces.push_back(piece_of(expected.call, wanted));
      }
    }
    find(pieces);
    return true;
  }

  // Finds this call, and the next expected calls of the same cost, unless cheaper ones may spare
  // them.
  void find_some(std::size_t function, const StudyCall& call) {
    const schema::Cost cost = cost_of(function);
    const auto place = place_.find(call);
    WantedNumbers wanted{};
    if (place != place_.end()) wanted = of_cost(expected_[place->second].wanted, cost);
    wanted[function] = true;
    std::vector<Piece> pieces = {piece_of(call, wanted)};
    const std::size_t most = place == place_.end() || cost != least_cost()
                                 ? 1
                                 : kAtOnce * static_cast<std::size_t>(usable_threads());
    for (std::size_t k = most > 1 ? place->second + 1 : 0;
         k < expected_.size() && pieces.size() < most; ++k) {
      const Expected& next = expected_[k];
      const WantedNumbers its = of_cost(next.wanted, cost);
      if (is_new(next.call, its)) pieces.push_back(piece_of(next.call, its));
    }
    find(pieces);
  }

  void find(const std::vector<Piece>& pieces) {
    const auto threads = std::min(static_cast<std::size_t>(usable_threads()), pieces.size());
    if (models_.size() < threads) models_.resize(threads);
    on_threads(
        threads, pieces.size(),
        [&](std::size_t thread) {
          if (!models_[thread]) models_[thread] = std::make_unique<FoldingModel>(campaign());
          return
              [&, model = models_[thread].get(), target = campaign().target.get()](std::size_t k) {
                const Piece& piece = pieces[k];
                const solver::Sheet sheet = model->sheet(piece.shifts_mm);
                return find_numbers(sheet, model->design(), piece.call.from_deg, piece.wanted,
                                    piece.is_candidate, target);
              };
        },
        [&](std::size_t k, const StudyNumbers& found) {
          known_->add(pieces[k].call, pieces[k].shifts_mm, found);
          ++sheets_;
          show_work("sheets studied", sheets_, std::max(expected_.size(), sheets_));
          return true;
        });
  }

  bool is_new(const StudyCall& call, const WantedNumbers& wanted) {
    for (std::size_t k = 0; k < kNumberCount; ++k) {
      if (wanted[k] && !find_known(k, call)) return true;
    }
    return false;
  }

  const std::optional<double>* find_known(std::size_t function, const StudyCall& call) {
    if (!known_) known_.emplace(campaign(), path_);
    return known_->find(function, call, [&](std::uint64_t draw) {
      return shifts_of_number(database_, campaign(), draw);
    });
  }

  Piece piece_of(const StudyCall& call, const WantedNumbers& wanted) {
    return {call, wanted, shifts_of_number(database_, campaign(), call.draw),
            is_candidate(call.draw)};
  }

  // Returns whether it is a candidate that certainly deploys from kDeployFrom_deg.
  bool is_candidate(std::uint64_t draw) {
    if (campaign().threshold_deg < solver::kDeployFrom_deg) return false;
    // The statement ends with the call: the connection must be able to close.
    SQLite::Statement candidate(database_, "SELECT 1 FROM candidate WHERE draw = ?");
    candidate.bind(1, static_cast<std::int64_t>(draw));
    return candidate.executeStep();
  }

  const schema::Campaign& campaign() {
    if (!campaign_) {
      own_campaign_ = schema::read_campaign_of(database_, path_);
      campaign_ = &*own_campaign_;
    }
    return *campaign_;
  }

  static inline std::mutex mutex_;
  static inline std::map<sqlite3*, StudyFunctions*> all_;  // by their connections

  SQLite::Database& database_;
  sqlite3* connection_ = nullptr;
  const std::string path_;
  std::optional<schema::Campaign> own_campaign_;
  const schema::Campaign* campaign_;
  const Unknown unknown_;
  std::vector<std::unique_ptr<FoldingModel>> models_;  // one for each thread
  std::optional<KnownNumbers> known_;                  // made when it is first needed
  bool is_looking_ahead_ = false;
  int turns_ = 0;                   // of looking ahead
  std::vector<Expected> expected_;  // in their order
  std::map<StudyCall, std::size_t> place_;
  std::size_t sheets_ = 0;
};

struct OneFunction {
  std::shared_ptr<StudyFunctions> functions;
  std::size_t which;
};

void call(sqlite3_context* context, int count, sqlite3_value** values) {
  const auto& function = *static_cast<const OneFunction*>(sqlite3_user_data(context));
  if (!has("SUNDIALS") && needs_sundials(function.which)) {
    sqlite3_result_error(context, schema::missing_text("SUNDIALS").c_str(), -1);
    return sqlite3_result_error_code(context, SQLITE_ABORT);
  }
  const bool has_angle = count > 1 && sqlite3_value_numeric_type(values[1]) != SQLITE_NULL;
  const double from_deg = has_angle ? sqlite3_value_double(values[1]) : solver::kDeployFrom_deg;
  if (sqlite3_value_numeric_type(values[0]) != SQLITE_INTEGER ||
      sqlite3_value_int64(values[0]) < 0 || !(from_deg > 0 && from_deg <= 180)) {
    return sqlite3_result_null(context);
  }
  try {
    const std::optional<double> number = function.functions->number(
        function.which, {static_cast<std::uint64_t>(sqlite3_value_int64(values[0])),
                         has_angle ? std::optional(from_deg) : std::nullopt});
    number ? sqlite3_result_double(context, *number) : sqlite3_result_null(context);
  } catch (const std::bad_alloc&) {
    sqlite3_result_error_nomem(context);
  } catch (const std::exception& error) {
    sqlite3_result_error(context, error.what(), -1);
  }
}

void forget(void* function) { delete static_cast<OneFunction*>(function); }

void add(SQLite::Database& database, const std::string& path, const schema::Campaign* campaign,
         Unknown unknown) {
  const auto functions = std::make_shared<StudyFunctions>(database, path, campaign, unknown);
  functions->add();
  for (std::size_t k = 0; k < kNumberCount; ++k) {
    for (const int count : {1, 2}) {
      sqlite3_create_function_v2(database.getHandle(), std::string(sheet_number_names()[k]).c_str(),
                                 count, SQLITE_UTF8 | SQLITE_DETERMINISTIC,
                                 new OneFunction{functions, k}, call, nullptr, nullptr, forget);
    }
  }
}

}  // namespace

void add_study_functions(SQLite::Database& database, const std::string& path) {
  add(database, path, nullptr, Unknown::is_computed);
}

void add_study_functions(SQLite::Database& database, const schema::Campaign& campaign,
                         const std::string& path, Unknown unknown) {
  add(database, path, &campaign, unknown);
}

void look_ahead(SQLite::Database& database, const std::string& sql) {
  StudyFunctions* const functions = StudyFunctions::of(database.getHandle());
  if (functions && schema::calls_costly(sql)) functions->look_ahead(sql, schema::has_limit(sql));
}

}  // namespace misalign::search
