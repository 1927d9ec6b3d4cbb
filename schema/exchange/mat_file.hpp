// Writes MAT-files of level 5, which MATLAB 7 and later, Octave and SciPy read, by libmatio.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "schema/files/input.hpp"

struct matvar_t;

namespace misalign::schema {

/// A named value: a variable of a file, or a field of a struct. std::bad_alloc where memory is
/// exhausted.
class MatValue {
 public:
  /// A column of doubles (n x 1).
  static MatValue column(const std::string& name, std::span<const double> numbers);
  /// A matrix of doubles.
  static MatValue matrix(const std::string& name, const Eigen::MatrixXd& numbers);
  /// A three-dimensional array of doubles: the first index runs fastest.
  static MatValue box(const std::string& name, const std::array<std::size_t, 3>& dimensions,
                      std::span<const double> numbers);
  static MatValue integer(const std::string& name, std::int64_t number);
  /// A row of characters (1 x n, UTF-16); 0 x 0 where there is none.
  static MatValue text(const std::string& name, const std::string& utf8);
  static MatValue structure(const std::string& name, std::vector<MatValue> fields);
  /// A column of cells (n x 1).
  static MatValue cells(const std::string& name, std::vector<MatValue> values);
  /// An object as a struct ("A9-A15" as A9_A15), a number as a double, null as NaN, true and false
  /// as logicals, text as text, a list of numbers as a column, of objects as cells.
  static MatValue json(const std::string& name, const Json& value);

 private:
  friend std::string mat_file(const std::string& path, const std::vector<MatValue>& variables);
  struct Freed {
    void operator()(matvar_t* value) const;
  };
  explicit MatValue(matvar_t* value);

  std::unique_ptr<matvar_t, Freed> value_;
};

/// The bytes of a file: compressed where matio can, and the same from the same values. `path` is
/// its name in sentences. UserError (failure) where matio fails.
std::string mat_file(const std::string& path, const std::vector<MatValue>& variables);

}  // namespace misalign::schema
