// Numbers of studies that were computed before, in a file beside the catalogue.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/campaign/campaign.hpp"
#include "schema/catalogue/database.hpp"

namespace misalign::schema {

/// A number of a sheet.
struct StudyNumber {
  std::string function;            ///< name in the table of studies, which has its version
  std::optional<double> from_deg;  ///< angle of use; none: the default
  std::uint64_t draw = 0;
  std::string sheet;            ///< sheet_key of its shifts
  std::optional<double> value;  ///< none also where the study has none
};

/// Returns XXH3-128 of a sheet's shifts, one column per vertex: 32 hex digits.
std::string sheet_key(const Eigen::Matrix2Xd& shifts_mm);

/// Finds and keeps numbers in CATALOGUE.studies, an SQLite file that may be deleted at any time. A
/// number is found where function, its version, campaign with design, angle, draw and shifts are
/// those with which it was kept. Faults of the file are no errors: nothing is found or kept from
/// then on, and fault() says why. For one thread at a time.
class StudyMemory {
 public:
  /// `catalogue`: its path; empty: nothing is found or kept.
  StudyMemory(const std::string& catalogue, const Campaign& campaign);

  static std::string path_beside(const std::string& catalogue) { return catalogue + ".studies"; }

  /// Sets the number's value; false if it was not kept.
  bool find(StudyNumber& number);
  /// Keeps numbers in one transaction, replacing those of other sheets.
  void keep(const std::vector<StudyNumber>& numbers);

  /// Functions with numbers from the default angle of use.
  std::vector<std::string> functions();
  /// All numbers that can be found, in the order of function, angle and draw.
  std::vector<StudyNumber> all();
  /// Count of the others: of another design or campaign, or another version of a function.
  std::uint64_t stale();

  /// A sentence for people on why the file is not used; empty if it is.
  const std::string& fault() const { return fault_; }
  const std::string& path() const { return path_; }

 private:
  enum class Missing { stays, is_made };  // what becomes of a file that is not there
  bool is_open(Missing missing);
  template <class Work>
  auto trying(const Work& work) -> decltype(work());

  const std::string path_;    // empty: no memory
  const std::string inputs_;  // hash of the campaign with its design
  std::string fault_;
  std::unique_ptr<SQLite::Database> database_;
  std::unique_ptr<SQLite::Statement> finding_;  // a number's row
};

}  // namespace misalign::schema
