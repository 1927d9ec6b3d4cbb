// Binds `_misalign.Catalogue`: read-only, with a connection for each call, so that threads and
// forks share none.
#include <fcntl.h>
#include <pybind11/stl.h>
#include <sys/stat.h>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/query_text.hpp"
#include "schema/catalogue/result_table.hpp"
#include "schema/exchange/tolerance_json.hpp"
#include "search/python/arrays.hpp"
#include "search/python/bindings.hpp"
#include "search/python/copies.hpp"
#include "search/python/draw_numbers.hpp"
#include "search/python/folding.hpp"
#include "search/python/histories.hpp"
#include "search/python/made.hpp"
#include "search/python/signals.hpp"
#include "search/python/table_columns.hpp"
#include "search/sheets/campaign_sheet.hpp"
#include "search/sheets/choice.hpp"
#include "search/sheets/study_functions.hpp"
#include "search/sheets/study_json.hpp"
#include "search/sheets/tolerance.hpp"

namespace misalign::search::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

// Identity of the file behind a name. A new file may get the number of a removed one, but not its
// time of birth, if the file system keeps that.
struct FileIdentity {
  bool operator==(const FileIdentity&) const = default;
  std::uint64_t device = 0, number = 0;
  std::int64_t born_s = 0, born_ns = 0;

  static FileIdentity of(const std::string& path) {
    struct statx found {};
    if (statx(AT_FDCWD, path.c_str(), 0, STATX_INO | STATX_BTIME, &found) != 0) return {};
    const std::uint64_t device = std::uint64_t{found.stx_dev_major} << 32 | found.stx_dev_minor;
    return {device, found.stx_ino, found.stx_btime.tv_sec, found.stx_btime.tv_nsec};
  }
};

class Catalogue {
 public:
  explicit Catalogue(std::string path) : path_(std::move(path)) {
    unlocked([&] {
      const auto database = schema::open_for_reading(path_);
      file_ = FileIdentity::of(path_);
      identity_ = identity_of(*database);
      source_ = source_of(schema::read_campaign_of(*database, path_));
    });
  }

  std::shared_ptr<PatternSource> sheet() const { return source_; }

  py::dict candidates(const std::string& where, const std::optional<std::string>& by,
                      const std::optional<std::uint64_t>& limit,
                      const std::vector<std::string>& columns) const {
    Choice choice;
    choice.where = where;
    choice.by = by;
    choice.best = limit;
    const auto database = open_for_queries();
    return table_of_query(*database, unlocked([&] {
      std::string found = "*";
      for (const std::string& column : columns) found += ", " + column_sql(*database, column);
      return best_sql(*database, found, choice);
    }));
  }

  py::dict query(const std::string& name_or_sql) const {
    const auto database = open_for_queries();
    return table_of_query(*database,
                          unlocked([&] { return schema::query_text(*database, name_or_sql).sql; }));
  }

  py::array_t<double> shifts(const py::object& draws) const {
    const std::vector<std::uint64_t> numbers = draw_numbers(draws);
    const auto vertices = static_cast<std::size_t>(source_->vertices());
    py::array_t<double> table({numbers.size(), vertices, std::size_t{2}});
    double* to = table.mutable_data();
    unlocked([&] {
      for (const Eigen::Matrix2Xd& one_mm : shifts_of(numbers)) {
        to = std::copy_n(one_mm.data(), one_mm.size(), to);
      }
    });
    return table;
  }

  py::tuple histories(const py::object& draws) const {
    const std::vector<std::uint64_t> numbers = draw_numbers(draws);
    return histories_of(*source_, unlocked([&] { return shifts_of(numbers); }));
  }

  py::dict replay(const py::object& number, const py::object& stations) const {
    const std::uint64_t draw = draw_number(number);
    const auto stations_deg = stations_of(stations);
    return fold(*source_, unlocked([&] { return shifts_of({draw}).front(); }), stations_deg);
  }

  std::shared_ptr<PatternSource> pattern(const py::object& number) const {
    const std::uint64_t draw = draw_number(number);
    return unlocked([&] {
      return with_shifts(*source_, shifts_of({draw}).front(),
                         source_->campaign->name + "-" + std::to_string(draw));
    });
  }

  std::string springs(const py::object& number) const {
    const std::uint64_t draw = draw_number(number);
    return unlocked([&] {
      const Subject subject(sheet_of_draw(*source_->campaign, draw, shifts_of({draw}).front()), {});
      return study_json(subject, actuated(subject.sheet, subject.model.design())).dump();
    });
  }

  std::string tolerance(const py::object& number, double amplitude_mm, std::int64_t trials,
                        std::int64_t jobs, const std::optional<double>& from_deg) const {
    const std::uint64_t draw = draw_number(number);
    ToleranceOptions options = copies_of(trials, jobs);
    schema::check_design("amplitude_mm", "miscut_mm", amplitude_mm);
    if (from_deg) schema::check_design("from_deg", "from_deg", *from_deg);
    options.amplitude_mm = amplitude_mm;
    options.filled = filled_by(source_->campaign->design, source_->sheet.base.base);
    return unlocked([&] {
      const std::vector<Eigen::Matrix2Xd> shifts_mm = shifts_of({draw});
      check_miscut(amplitude_mm, source_->pattern(), shifts_mm.front(),
                   "draw " + std::to_string(draw));
      const auto used_deg = from_deg ? from_deg : source_->campaign->design.from_deg;
      const schema::Campaign used =
          used_deg ? used_from(*source_->campaign, *used_deg, shifts_mm, options,
                               [&](std::size_t) { return "draw " + std::to_string(draw); })
                   : *source_->campaign;
      schema::Json json = schema::tolerance_json(study_tolerance(used, shifts_mm, options).front());
      json["draw"] = draw;
      return json.dump();
    });
  }

 private:
  static std::string identity_of(SQLite::Database& database) {
    return schema::reading(
        database, [&] { return database.execAndGet("SELECT identity FROM campaign").getString(); });
  }

  // Opens the file again and refuses any other than the first, whose campaign is source_.
  std::unique_ptr<SQLite::Database> open() const {
    auto database = schema::open_for_reading(path_);
    const auto refuse = [&](const std::string& what) {
      return schema::UserError(
          schema::Cause::foreign,
          path_ + ": " + what +
              " was opened (it was replaced); open it again with misalign.Catalogue");
    };
    if (identity_of(*database) != identity_)
      throw refuse("holds another campaign than the file that");
    if (FileIdentity::of(path_) != file_) throw refuse("is another file than the one that");
    return database;
  }

  std::unique_ptr<SQLite::Database> open_for_queries() const {
    return unlocked([&] {
      auto opened = open();
      add_study_functions(*opened, *source_->campaign, path_);
      return opened;
    });
  }

  std::vector<Eigen::Matrix2Xd> shifts_of(const std::vector<std::uint64_t>& draws) const {
    const auto database = open();
    std::vector<Eigen::Matrix2Xd> all_mm;
    for (const std::uint64_t draw : draws) {
      all_mm.push_back(shifts_of_number(*database, *source_->campaign, draw));
    }
    return all_mm;
  }

  const std::string path_;
  FileIdentity file_;
  std::string identity_;
  std::shared_ptr<PatternSource> source_;
};

}  // namespace

void bind_catalogues(py::module_& module) {
  py::class_<Catalogue, std::shared_ptr<Catalogue>>(module, "Catalogue")
      .def(py::init<std::string>(), "path"_a)
      .def("sheet", made(&Catalogue::sheet))
      .def("candidates", made(&Catalogue::candidates), "where"_a, "by"_a, "limit"_a, "columns"_a)
      .def("query", made(&Catalogue::query), "name_or_sql"_a)
      .def("shifts", made(&Catalogue::shifts), "draws"_a)
      .def("histories", made(&Catalogue::histories), "draws"_a)
      .def("replay", made(&Catalogue::replay), "draw"_a, "stations"_a)
      .def("pattern", made(&Catalogue::pattern), "draw"_a)
      .def("springs", made(&Catalogue::springs), "draw"_a)
      .def("tolerance", made(&Catalogue::tolerance), "draw"_a, "amplitude_mm"_a, "trials"_a,
           "jobs"_a, "from_deg"_a);
}

}  // namespace misalign::search::python
