// Numbers of studies that need no computing: found on this connection before, or remembered beside
// the catalogue.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "schema/memory/study_memory.hpp"
#include "search/sheets/sheet_numbers.hpp"
#include "search/terminal/stopwatch.hpp"

namespace misalign::search {

/// A draw, and its angle of use; the default angle where there is none.
struct StudyCall {
  std::uint64_t draw;
  std::optional<double> from_deg;

  auto operator<=>(const StudyCall&) const = default;
};

/// Uses the StudyMemory of the catalogue at `path`, if there is a path. Warns once of a file that
/// cannot be used. The campaign is not used after the constructor.
class KnownNumbers {
 public:
  KnownNumbers(const schema::Campaign& campaign, const std::string& path)
      : memory_(path, campaign), has_memory_(!path.empty()) {}
  ~KnownNumbers() { remember(); }
  KnownNumbers(const KnownNumbers&) = delete;
  KnownNumbers& operator=(const KnownNumbers&) = delete;

  /// Returns the number of a function of sheet_number_names(); null if it is not known.
  /// `shifts_of(draw)`: the draw's shifts.
  template <class ShiftsOf>
  const std::optional<double>* find(std::size_t function, const StudyCall& call,
                                    const ShiftsOf& shifts_of) {
    const auto known = numbers_.find(call);
    if (known != numbers_.end() && known->second.is_found[function]) {
      return &known->second.numbers[function];
    }
    if (!has_memory_) return nullptr;
    schema::StudyNumber number = described(function, call, shifts_of(call.draw));
    const bool is_found = memory_.find(number);
    warn_once();
    return is_found ? &set(function, call, number.value) : nullptr;
  }

  /// Takes computed numbers in, and keeps them within a second or so.
  void add(const StudyCall& call, const Eigen::Matrix2Xd& shifts_mm, const StudyNumbers& computed);

 private:
  static schema::StudyNumber described(std::size_t function, const StudyCall& call,
                                       const Eigen::Matrix2Xd& shifts_mm);
  const std::optional<double>& set(std::size_t function, const StudyCall& call,
                                   std::optional<double> number);
  void remember();
  void warn_once();

  schema::StudyMemory memory_;
  const bool has_memory_;
  bool has_warned_ = false;
  std::map<StudyCall, StudyNumbers> numbers_;
  std::vector<schema::StudyNumber> unkept_;
  Stopwatch since_kept_;
};

}  // namespace misalign::search
