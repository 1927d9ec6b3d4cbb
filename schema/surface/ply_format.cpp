#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "schema/files/text_lines.hpp"
#include "schema/surface/polygon_list.hpp"

namespace misalign::schema {
namespace {

constexpr std::size_t kMostCorners = 1000;  ///< elements of a list

template <class Number>
double number_at(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof(number));
  return static_cast<double>(number);
}

struct NumberType {
  std::string_view name, other_name;
  std::size_t bytes;
  double (*read)(const char* bytes);
};
constexpr std::array<NumberType, 8> kNumberTypes = {
    {{"char", "int8", 1, number_at<std::int8_t>},
     {"uchar", "uint8", 1, number_at<std::uint8_t>},
     {"short", "int16", 2, number_at<std::int16_t>},
     {"ushort", "uint16", 2, number_at<std::uint16_t>},
     {"int", "int32", 4, number_at<std::int32_t>},
     {"uint", "uint32", 4, number_at<std::uint32_t>},
     {"float", "float32", 4, number_at<float>},
     {"double", "float64", 8, number_at<double>}}};

const NumberType* type_named(std::string_view name) {
  const auto at = std::ranges::find_if(kNumberTypes, [&](const NumberType& type) {
    return type.name == name || type.other_name == name;
  });
  return at == kNumberTypes.end() ? nullptr : at;
}

struct Property {
  std::string_view name;
  const NumberType* count;  // null: a single number
  const NumberType* type;
};

struct Element {
  std::string_view name;
  std::size_t count;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  PlyReader(std::string_view bytes, InputFaults& faults) : left_(bytes), faults_(faults) {}

  PolygonList read() {
    if (!read_header()) return {};
    for (const Element& element : elements_) {
      for (std::size_t k = 0; k < element.count && !element.properties.empty(); ++k) {
        if (!read_element(element, k)) return {};
        if (list_.faces.size() > kMostPolygons) return std::move(list_);
      }
    }
    return std::move(list_);
  }

 private:
  enum class Form { text, little, big };

  bool fail(const std::string& problem, const std::string& why) {
    faults_.add(problem, why, "write the file again from the program it comes from");
    return false;
  }

  std::string_view take_line() {
    const std::size_t end = std::min(left_.find('\n'), left_.size());
    const std::string_view line = left_.substr(0, end);
    left_.remove_prefix(std::min(end + 1, left_.size()));
    return line;
  }

  bool read_header() {
    std::optional<Form> form;
    while (!left_.empty()) {
      const std::string_view line = take_line();
      const Words words = words_of(line);
      const std::string_view key = words.empty() ? "" : words[0];
      if (key == "end_header") {
        form_ = form.value_or(Form::text);
        return form ? true : fail("PLY", "has no format that is known");
      }
      if (key == "format" && words.size() >= 2) {
        if (words[1] == "ascii") form = Form::text;
        if (words[1] == "binary_little_endian") form = Form::little;
        if (words[1] == "binary_big_endian") form = Form::big;
      }
      const bool is_right = key == "element"    ? add_element(words)
                            : key == "property" ? add_property(words)
                                                : true;
      if (!is_right) return fail("PLY's line \"" + std::string(line) + "\"", "is not understood");
    }
    return fail("PLY", "has no end_header");
  }

  bool add_element(const Words& words) {
    const auto count =
        words.size() == 3 ? number_of<std::size_t>(words[2]) : std::optional<std::size_t>();
    if (count) elements_.push_back({words[1], *count, {}});
    return count.has_value();
  }

  bool add_property(const Words& words) {
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (elements_.empty() || (!is_list && words.size() != 3)) return false;
    const Property property{words.back(), is_list ? type_named(words[2]) : nullptr,
                            type_named(words[words.size() - 2])};
    elements_.back().properties.push_back(property);
    return property.type && (property.count != nullptr || !is_list);
  }

  // Reads a number of the file's form. NaN at the end of the file, and for a word that is none.
  double next(const NumberType& type) {
    if (form_ == Form::text) {
      constexpr std::string_view kSpace = " \t\r\n\f\v";
      left_.remove_prefix(std::min(left_.find_first_not_of(kSpace), left_.size()));
      const std::string_view word = left_.substr(0, left_.find_first_of(kSpace));
      left_.remove_prefix(word.size());
      return number_of<double>(word).value_or(std::nan(""));
    }
    if (left_.size() < type.bytes) {
      left_ = {};
      return std::nan("");
    }
    std::array<char, sizeof(double)> bytes{};
    std::copy_n(left_.begin(), type.bytes, bytes.begin());
    left_.remove_prefix(type.bytes);
    if (form_ == Form::big)
      std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(type.bytes));
    return type.read(bytes.data());
  }

  bool read_element(const Element& element, std::size_t number) {
    const std::string name = fmt::format("{} {}", element.name, number);
    Eigen::Vector3d point_mm = Eigen::Vector3d::Constant(std::nan(""));
    std::vector<double> values;
    for (const Property& property : element.properties) {
      const double count = property.count ? next(*property.count) : 1;
      if (!(count >= 0 && count <= kMostCorners)) return fail(name, "is not whole");
      values.clear();
      for (int k = 0; k < count; ++k) values.push_back(next(*property.type));
      const bool is_known = std::ranges::all_of(values, [](double x) { return std::isfinite(x); });
      if (!is_known) return fail(name, left_.empty() ? "is not whole" : "needs finite numbers");
      if (element.name == "vertex" && !property.count && property.name.size() == 1) {
        const auto axis = std::string_view("xyz").find(property.name);
        if (axis < 3) point_mm(static_cast<Eigen::Index>(axis)) = values[0];
      }
      if (element.name == "face" && property.count && property.name.starts_with("vertex_ind")) {
        std::vector<int>& face = list_.faces.emplace_back();
        for (const double x : values) face.push_back(std::abs(x) < 1e9 ? static_cast<int>(x) : -1);
      }
    }
    if (element.name != "vertex") return true;
    list_.points_mm.push_back(point_mm);
    return point_mm.allFinite() ? true : fail(name, "has no x, y and z");
  }

  std::string_view left_;
  InputFaults& faults_;
  Form form_ = Form::text;
  std::vector<Element> elements_;
  PolygonList list_;
};

}  // namespace

PolygonList read_ply(std::string_view bytes, InputFaults& faults) {
  return PlyReader(bytes, faults).read();
}

}  // namespace misalign::schema
