#include "schema/exchange/mat_file.hpp"

#include <matio.h>

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <limits>
#include <new>
#include <utility>

#include "schema/files/memory_file.hpp"

namespace misalign::schema {
namespace {

// The header has no time, which matio would write by default.
constexpr const char* kHeader = "MATLAB 5.0 MAT-file, written by misalign";

matvar_t* array_of(const std::string& name, matio_classes kind, matio_types type,
                   std::vector<std::size_t> dimensions, const void* data, int flags = 0) {
  // Data are copied, so that they may be constant; empty ones have no address.
  static const double kNothing = 0;
  return Mat_VarCreate(name.c_str(), kind, type, static_cast<int>(dimensions.size()),
                       dimensions.data(), const_cast<void*>(data ? data : &kNothing), flags);
}

matvar_t* doubles(const std::string& name, std::vector<std::size_t> dimensions,
                  const double* numbers) {
  return array_of(name, MAT_C_DOUBLE, MAT_T_DOUBLE, std::move(dimensions), numbers);
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw UserError(Cause::failure, path + ": cannot be written (libmatio: " + why +
                                      "); check disk and memory, or take " +
                                      parameter("format", "csv"));
}

}  // namespace

void MatValue::Freed::operator()(matvar_t* value) const { Mat_VarFree(value); }

MatValue::MatValue(matvar_t* value) : value_(value) {
  if (!value) throw std::bad_alloc();
}

MatValue MatValue::column(const std::string& name, std::span<const double> numbers) {
  return MatValue(doubles(name, {numbers.size(), 1}, numbers.data()));
}

MatValue MatValue::matrix(const std::string& name, const Eigen::MatrixXd& numbers) {
  return MatValue(doubles(
      name, {static_cast<std::size_t>(numbers.rows()), static_cast<std::size_t>(numbers.cols())},
      numbers.data()));
}

MatValue MatValue::box(const std::string& name, const std::array<std::size_t, 3>& dimensions,
                       std::span<const double> numbers) {
  assert(numbers.size() == dimensions[0] * dimensions[1] * dimensions[2]);
  return MatValue(doubles(name, {dimensions.begin(), dimensions.end()}, numbers.data()));
}

MatValue MatValue::integer(const std::string& name, std::int64_t number) {
  return MatValue(array_of(name, MAT_C_INT64, MAT_T_INT64, {1, 1}, &number));
}

MatValue MatValue::text(const std::string& name, const std::string& utf8) {
  const std::u16string units = std::filesystem::path(utf8).u16string();
  return MatValue(array_of(name, MAT_C_CHAR, MAT_T_UTF16,
                           {units.empty() ? std::size_t{0} : std::size_t{1}, units.size()},
                           units.data()));
}

MatValue MatValue::structure(const std::string& name, std::vector<MatValue> fields) {
  std::vector<const char*> names;
  for (const MatValue& field : fields) names.push_back(field.value_->name);
  std::size_t scalar[] = {1, 1};
  MatValue whole(Mat_VarCreateStruct(name.c_str(), 2, scalar, names.data(),
                                     static_cast<unsigned>(names.size())));
  for (std::size_t i = 0; i < fields.size(); ++i) {
    Mat_VarSetStructFieldByIndex(whole.value_.get(), i, 0, fields[i].value_.release());
  }
  return whole;
}

MatValue MatValue::cells(const std::string& name, std::vector<MatValue> values) {
  std::size_t dimensions[] = {values.size(), 1};
  MatValue whole(Mat_VarCreate(name.c_str(), MAT_C_CELL, MAT_T_CELL, 2, dimensions, nullptr, 0));
  for (std::size_t i = 0; i < values.size(); ++i) {
    Mat_VarSetCell(whole.value_.get(), static_cast<int>(i), values[i].value_.release());
  }
  return whole;
}

MatValue MatValue::json(const std::string& name, const Json& value) {
  if (value.is_object()) {
    std::vector<MatValue> fields;
    for (const auto& [key, field] : value.items()) {
      std::string its_name = key;
      std::ranges::replace(its_name, '-', '_');
      fields.push_back(json(its_name, field));
    }
    return structure(name, std::move(fields));
  }
  if (value.is_array() && !value.empty() && value.front().is_object()) {
    std::vector<MatValue> elements;
    for (const Json& element : value) elements.push_back(json("", element));
    return cells(name, std::move(elements));
  }
  if (value.is_string()) return text(name, value.get<std::string>());
  if (value.is_boolean()) {
    const std::uint8_t truth = value.get<bool>() ? 1 : 0;
    return MatValue(array_of(name, MAT_C_UINT8, MAT_T_UINT8, {1, 1}, &truth, MAT_F_LOGICAL));
  }
  std::vector<double> numbers;
  const auto add = [&](const Json& number) {
    numbers.push_back(number.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                       : number.get<double>());
  };
  if (value.is_array()) {
    for (const Json& number : value) add(number);
  } else {
    add(value);
  }
  return column(name, numbers);
}

// matio writes to memory: it does not check its writes, so that a full disk would go unnoticed.
std::string mat_file(const std::string& path, const std::vector<MatValue>& variables) {
  const MemoryFile memory(path);
  mat_t* const file = Mat_CreateVer(memory.path().c_str(), kHeader, MAT_FT_MAT5);
  if (!file) refuse(path, "no file can be opened in /proc/self/fd");
  for (const MatValue& variable : variables) {
    if (Mat_VarWrite(file, variable.value_.get(), MAT_COMPRESSION_ZLIB) == 0) continue;
    const std::string name = variable.value_->name;
    Mat_Close(file);
    refuse(path, "the variable " + name + " cannot be written");
  }
  if (Mat_Close(file) != 0) refuse(path, "the file cannot be closed");
  return memory.bytes();
}

}  // namespace misalign::schema
