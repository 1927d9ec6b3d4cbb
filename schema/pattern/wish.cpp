#include "schema/pattern/wish.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

#include "schema/files/json_values.hpp"
#include "schema/pattern/pattern_document.hpp"

namespace misalign::schema {
namespace {

constexpr double kLeastShift_mm = 1e-6, kMostShift_mm = 1e6;
constexpr char kForms[] = R"(write two bounds, [1.5, 3], or a list, {"of": [1.5, 2, 3]})";

// Returns the numbers of a range or list, in ascending order; empty with a fault.
std::vector<double> read_values(ObjectReader& reader, const std::string& key, const Json& value,
                                const DesignLimits& within) {
  const bool is_list = value.is_object() && value.size() == 1 && value.contains("of");
  const Json& numbers = is_list ? value["of"] : value;
  const bool are_some = numbers.is_array() && !numbers.empty() &&
                        std::ranges::all_of(numbers, [](const Json& n) { return n.is_number(); });
  if (!are_some || (!is_list && numbers.size() != 2)) {
    reader.faults().add(reader.shown(key), "is neither two bounds nor a list", kForms);
    return {};
  }
  auto values = numbers.get<std::vector<double>>();
  if (!std::ranges::is_sorted(values) && !is_list) {
    reader.faults().add(reader.shown(key), "the first bound is above the second", kForms);
    return {};
  }
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (!(values.front() >= within.least && values.back() <= within.most)) {
    reader.faults().add(reader.shown(key),
                        "leaves " + shown_number(within.least) + " to " + shown_number(within.most),
                        "stay within these bounds");
    return {};
  }
  return values;
}

// Returns the row of a free number's key: "preload_n", or "plate.prestretch".
const DesignNumber* row_of(std::string_view key) {
  constexpr std::string_view kPlate = "plate.";
  const bool is_plate = key.starts_with(kPlate);
  if (is_plate) key.remove_prefix(kPlate.size());
  const auto row = std::ranges::find_if(design_numbers(), [&](const DesignNumber& other) {
    return other.key == key && (other.block == "plate") == is_plate;
  });
  return row == design_numbers().end() ? nullptr : &*row;
}

void read_number(ObjectReader& reader, const std::string& key, const Json& value, Free& free) {
  const DesignNumber* const row = row_of(key);
  if (row->block == "wanted") {
    return reader.faults().add(reader.shown(key), "is a requirement, which is not chosen",
                               "write it into \"design\"");
  }
  const std::vector<double> values = read_values(reader, key, value, {row->least, row->most});
  if (values.empty()) return;
  const bool is_range = value.is_array();
  if (row->number != &Design::from_deg) {
    return free.numbers.push_back({row, values, is_range});
  }
  free.from_deg = values;
  if (is_range && values.size() == 2)
    free.from_deg.insert(free.from_deg.begin() + 1, std::midpoint(values[0], values[1]));
  std::ranges::reverse(free.from_deg);
}

// Reads a list of values for another key, which are checked where it is read.
void read_list(ObjectReader& reader, const char* key, std::vector<Json>& choices,
               const char* suggestion) {
  const Json* const value = reader.said(key);
  if (value == nullptr) return;
  if (!value->is_array() || value->empty()) {
    return reader.faults().add(reader.name(key), "is no list of choices", suggestion);
  }
  choices.assign(value->begin(), value->end());
  for (auto at = choices.begin(); at != choices.end(); ++at) {
    if (std::find(choices.begin(), at, *at) == at) continue;
    return reader.faults().add(reader.name(key) + " has " + at->dump() + " twice", "choices differ",
                               "name each once");
  }
}

Free read_free(const Json& value, InputFaults& faults) {
  Free free;
  ObjectReader reader(value, "free", faults);
  if (const Json* shifts = reader.said("amplitude_mm")) {
    const auto values =
        read_values(reader, "amplitude_mm", *shifts, {kLeastShift_mm, kMostShift_mm});
    if (!values.empty()) free.amplitude_mm = {values.front(), values.back()};
  }
  read_list(reader, "holes", free.holes,
            R"(write ["checkerboard-odd", [[1, 1], [1, 3]]]; `misalign perforations` lists sets)");
  read_list(reader, "fill", free.fills,
            R"(write fillings such as [{"kind": "springs"}, {"kind": "plate"}])");
  const char* const kFlag = "write true where it may be chosen, or leave it out";
  reader.boolean("rim", free.rim, kFlag);
  reader.boolean("hold_flat", free.hold_flat, kFlag);
  reader.boolean("one_a_hole", free.one_a_hole, kFlag);
  if (value.is_object()) {
    for (const auto& [key, numbers] : value.items()) {
      if (row_of(key) == nullptr) continue;
      if (reader.said(key)) read_number(reader, key, numbers, free);
    }
  }
  reader.refuse_unknown_keys();
  return free;
}

}  // namespace

double FreeNumber::nearest(double value) const {
  if (is_range) return std::clamp(value, least(), most());
  const auto distance = [&](double other) {
    return other > 0 && value > 0 ? std::abs(std::log(other / value)) : std::abs(other - value);
  };
  return *std::ranges::min_element(values, {}, distance);
}

Wish read_wish(const std::string& path) {
  Wish wish{read_pattern_document(path), "", path, std::filesystem::path(path).parent_path(), {}};
  wish.text = wish.document.dump();
  InputFaults faults;
  if (!wish.document.is_object() || !wish.document.contains("free")) {
    faults.add("free", "is missing",
               "write what may be chosen beside the pattern and its \"design\", such as "
               R"("free": {"amplitude_mm": [0.4, 4], "thickness_mm": [1, 3]})");
  } else {
    const Json free = wish.document["free"];
    wish.document.erase("free");
    wish.free = read_free(free, faults);
  }
  faults.refuse(path);
  return wish;
}

std::string WishChoice::words() const {
  std::string words;
  if (holes)
    words += ", " + (holes->is_string() ? holes->get<std::string>() : "holes " + holes->dump());
  const bool is_kind = fill && fill->is_object() && fill->size() == 1 && fill->contains("kind");
  if (fill) words += ", " + (is_kind ? (*fill)["kind"].dump() : fill->dump());
  if (from_deg) words += ", for " + shown_number(*from_deg) + "°";
  return words;
}

std::vector<WishChoice> choices_of(const Free& free) {
  const auto each_or_none = [](const std::vector<Json>& values) {
    std::vector<const Json*> each;
    for (const Json& value : values) each.push_back(&value);
    if (each.empty()) each.push_back(nullptr);
    return each;
  };
  std::vector<std::optional<double>> angles_deg(free.from_deg.begin(), free.from_deg.end());
  if (angles_deg.empty()) angles_deg.emplace_back();
  std::vector<WishChoice> choices;
  for (const Json* const holes : each_or_none(free.holes)) {
    for (const Json* const fill : each_or_none(free.fills)) {
      for (const auto& from_deg : angles_deg) choices.push_back({holes, fill, from_deg});
    }
  }
  return choices;
}

Json wished_document(const Wish& wish, const WishChoice& choice) {
  Json document = wish.document;
  Json& pattern = document.contains("pattern") ? document["pattern"] : document;
  if (choice.holes != nullptr && pattern.is_object()) pattern["holes"] = *choice.holes;
  if (!choice.from_deg && choice.fill == nullptr) return document;
  Json& design = document["design"];
  if (!design.is_null() && !design.is_object()) return document;  // a fault where it is read
  if (choice.from_deg) design["from_deg"] = *choice.from_deg;
  if (choice.fill != nullptr) {
    if (design.is_object()) design.erase("springs");
    design["fill"] = *choice.fill;
  }
  return document;
}

}  // namespace misalign::schema
