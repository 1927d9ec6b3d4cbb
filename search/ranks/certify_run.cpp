#include "search/ranks/certify_run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <set>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/models.hpp"
#include "search/ranks/campaign_run.hpp"
#include "search/ranks/certify_task.hpp"
#include "search/ranks/coordinator.hpp"
#include "search/ranks/departure.hpp"
#include "search/ranks/run_info.hpp"
#include "search/ranks/stop_signal.hpp"
#include "search/sheets/campaign_sheet.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/terminal/count_text.hpp"
#include "search/terminal/long_work.hpp"
#include "search/terminal/shell_word.hpp"

namespace misalign::search {
namespace {

using schema::UserError;

// A chosen candidate, its requested angle and its certificate.
struct Chosen {
  std::uint64_t draw;
  double asked_deg = 0;
  Eigen::Matrix2Xd shifts_mm = {};  // stored shifts; those of a plain campaign are drawn again
  std::optional<schema::NamedCertificate> done = {};
  std::string end = {};  // of the certificate that is checked
};

double deploys_from_deg(SQLite::Database& database, const schema::Campaign& campaign,
                        std::uint64_t draw) {
  return schema::reading(database, [&] {
    SQLite::Statement row(database, "SELECT deploys_from_sample FROM candidate WHERE draw = ?");
    row.bind(1, schema::stored(draw));
    if (!row.executeStep()) {
      throw schema::damaged(database, "draw " + std::to_string(draw) + " has no row");
    }
    return row.getColumn(0).getInt() * campaign.sample_deg;
  });
}

std::string name_of_draw(std::uint64_t draw) { return SheetKey{draw, ""}.name(); }

// A rank's model and certifier.
struct CertifyWorkspace {
  static RankInfo info(const CertifyOptions&, const schema::Campaign&) {
    return {host_name(), certify_layout()};
  }
  CertifyWorkspace(schema::Campaign its_campaign, const CertifyOptions& options)
      : campaign(std::move(its_campaign)),
        model(model_of(campaign)),
        certifier(campaign.pattern, model,
                  claims_of(campaign, options.criterion, options.contact)) {}
  CertifyWorkspace(const CertifyWorkspace&) = delete;
  CertifyWorkspace& operator=(const CertifyWorkspace&) = delete;

  void work(const MpiSession& mpi) {
    run_worker(
        mpi, [&](const Bytes& job) { return CertifyWork(certifier, unpack_orders(job)); },
        [](CertifyWork& work, bool was_stopped) {
          SentResults sent = work.take();
          sent.was_stopped = was_stopped;
          return pack(sent);
        });
  }

  const schema::Campaign campaign;
  const solver::Model model;
  RowCertifier certifier;
};

// Private to rank 0: the catalogue, the progress and the remaining work.
class CertifyZero {
 public:
  using Workspace = CertifyWorkspace;

  explicit CertifyZero(const CertifyOptions& options)
      : options_(options),
        database_(schema::open_for_reading(options.path)),
        ready_(schema::read_campaign_of(*database_, options.path), options) {
    const MayBeLeft reading;
    std::set<std::uint64_t> chosen;
    for (const std::uint64_t draw : options.choose(*database_)) {
      if (chosen.insert(draw).second) add(draw);
    }
    report_.check.of = options.check ? open_.size() : 0;
    if (options.check && open_.empty()) throw nothing_to_check();
    // Another connection of this process would end the writer's lock: see WriterLock.
    if (!options.check) database_.reset();
  }

  const schema::Campaign& campaign() const { return ready_.campaign; }

  void begin(const std::vector<RankInfo>&) {
    if (options_.check || open_.empty()) return;
    catalogue_.emplace(options_.path, campaign(), ready_.model.mechanism(),
                       std::optional<schema::Storage>(), schema::Missing::refused);
  }

  // Returns the exit code.
  int run(const MpiSession& mpi, const Heartbeat& heartbeat) {
    task_.emplace(
        ready_.certifier,
        CertifyList{open_.size(), [&](std::size_t k) { return order_of(sheets_[open_[k]]); },
                    [&](std::vector<CertifyList::Done> done) { keep(std::move(done)); }},
        mpi.ranks());
    const LongWork work("certify is under way", work_style(launched_by_mpi()),
                        spdlog::should_log(spdlog::level::debug));
    const auto fold_in = [&] {
      if (catalogue_) catalogue_->fold_in();
    };
    const RunEnd end = run_coordinator(mpi, heartbeat, *task_, {{}, ProgressStyle::none, fold_in});
    if (catalogue_) catalogue_->close();
    if (end == RunEnd::lost) return options_.border.exit_code(schema::Cause::failure);
    if (!gone_.empty()) say_what_is_gone();
    return 0;
  }

  int leave() {
    if (task_) task_->commit_all();
    if (catalogue_) catalogue_->close();
    return conclude();
  }

  int conclude() {
    for (Chosen& sheet : sheets_) {
      if (sheet.done) {
        report_.sheets.push_back(std::move(*sheet.done));
      } else if (!options_.check) {
        ++report_.left;
      }
    }
    auto& findings = report_.check.findings;
    std::stable_sort(findings.begin(), findings.end(),
                     [](const auto& a, const auto& b) { return a.draw < b.draw; });
    options_.show(report_);
    return findings.empty() ? 0 : options_.border.exit_code(schema::Cause::check_failed);
  }

 private:
  UserError nothing_to_check() const {
    return {schema::Cause::bad_input,
            fmt::format("{}: there is nothing to check (none of {} has a certificate); make them: "
                        "misalign certify {} --all",
                        options_.path, count_text(sheets_.size(), "candidate"),
                        shell_word(options_.path))};
  }

  void add(std::uint64_t draw) {
    Chosen sheet{draw};
    auto row = schema::read_certificate(*database_, draw);
    if (options_.check) {
      row ? open_.push_back(sheets_.size()) : void(++report_.check.without);
      sheets_.push_back(std::move(sheet));
      return;
    }
    const auto from_deg = options_.to_deg ? options_.to_deg : campaign().design.from_deg;
    sheet.asked_deg = from_deg.value_or(deploys_from_deg(*database_, campaign(), draw));
    const Eigen::Matrix2Xd shifts_mm = shifts_of_number(*database_, ready_.campaign, draw);
    if (ready_.campaign.search.stores_sheets()) sheet.shifts_mm = shifts_mm;
    if (row && is_good(shifts_mm, *row, sheet.asked_deg)) {
      sheet.done = schema::named_certificate(name_of_draw(draw), std::move(*row), false);
    } else {
      open_.push_back(sheets_.size());
    }
    sheets_.push_back(std::move(sheet));
  }

  bool is_good(const Eigen::Matrix2Xd& shifts_mm, const schema::CertificateRecord& row,
               double asked_deg) const {
    if (options_.again) return false;
    if (const auto fault = ready_.certifier.row_fault(shifts_mm, row)) {
      spdlog::warn("{}: {}; its certificate is made again", name_of_draw(row.draw),
                   schema::printable(fault->what));
      return false;
    }
    return answers(row, asked_deg, ready_.certifier.claims());
  }

  CertifyOrder order_of(Chosen& sheet) {
    CertifyOrder order{sheet.draw, sheet.asked_deg, sheet.shifts_mm};
    if (options_.check) {
      order.stored = schema::read_certificate(*database_, sheet.draw);
      order.shifts_mm = shifts_of_number(*database_, ready_.campaign, sheet.draw);
      if (!order.stored) {
        throw schema::damaged(
            *database_, name_of_draw(sheet.draw) + " has lost its certificate during this run");
      }
      sheet.end = order.stored->end;
    } else if (!ready_.campaign.search.stores_sheets()) {
      order.shifts_mm = shifts_of_draw(ready_.campaign, sheet.draw);
    }
    return order;
  }

  void keep(std::vector<CertifyList::Done> done) {
    kept_ += done.size();
    show_work(options_.check ? "candidates checked" : "candidates certified", kept_, open_.size());
    if (options_.check) {
      report_.check.checked += done.size();
      for (auto& finished : done) {
        if (finished.result.finding) {
          report_.check.findings.push_back(std::move(*finished.result.finding));
        } else {
          ++report_.check.ends[sheets_[open_[finished.sheet]].end];
        }
      }
      return;
    }
    std::vector<schema::CertificateRecord> rows;
    for (auto& finished : done) rows.push_back(std::move(*finished.result.made));
    const std::vector<std::uint64_t> gone = catalogue_->keep(rows);
    gone_.insert(gone_.end(), gone.begin(), gone.end());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      Chosen& sheet = sheets_[open_[done[k].sheet]];
      sheet.done = schema::named_certificate(name_of_draw(sheet.draw), std::move(rows[k]), true);
    }
  }

  void say_what_is_gone() const {
    spdlog::warn(
        "{}: {} candidates are gone, such as draw {} (another catalogue has replaced this one); "
        "their certificates are not stored",
        options_.path, gone_.size(), gone_.front());
  }

  const CertifyOptions& options_;
  std::unique_ptr<SQLite::Database>
      database_;  // open during a check; otherwise closed before writing
  CertifyWorkspace ready_;
  std::vector<Chosen> sheets_;
  std::vector<std::size_t> open_;  // indices of sheets still to do
  std::size_t kept_ = 0;           // count of these
  std::optional<schema::Catalogue> catalogue_;
  std::optional<CertifyTask> task_;
  std::vector<std::uint64_t> gone_;
  CertifyReport report_;
};

}  // namespace

int run_certify(const CertifyOptions& options) { return run_campaign<CertifyZero>(options); }

}  // namespace misalign::search
