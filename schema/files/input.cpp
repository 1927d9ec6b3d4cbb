#include "schema/files/input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace misalign::schema {
namespace {

// A mesh of 80 x 80 panels has 0.8 MB; an endless device is refused, too.
constexpr std::size_t kLargest_bytes = 64 << 20;

// Exception thrown out of the library's parser: why a text is refused.
struct Unread {
  std::string why;
};

// Watches the parsing of JSON: refuses nesting so deep that it would exhaust the stack later, and
// duplicate keys, of which one would be ignored silently.
struct StructureGuard {
  static constexpr int kDeepest = 32;
  std::vector<std::set<std::string>> keys = {};  // keys of the open objects, by depth

  bool operator()(int depth, Json::parse_event_t event, const Json& parsed) {
    if (depth > kDeepest) {
      throw Unread{"is nested more than " + std::to_string(kDeepest) +
                   " levels deep (no valid file is); mend it there"};
    }
    const auto level = static_cast<std::size_t>(depth);
    if (event == Json::parse_event_t::object_start) {
      keys.resize(level + 2);
      keys[level + 1].clear();
    } else if (event == Json::parse_event_t::key) {
      const std::string key = parsed.get<std::string>();
      if (!keys.at(level).insert(key).second) {
        throw Unread{printable(key) + " occurs twice (only one can count); take one out"};
      }
    }
    return true;
  }
};

struct ParsedText {
  Json json;
  std::string why_not;  // empty: `json` is valid
};

ParsedText parsed(const std::string& text) {
  try {
    return {Json::parse(text, StructureGuard{}), ""};
  } catch (const Unread& unread) {
    return {{}, unread.why};
  } catch (const Json::exception& error) {
    std::string what = error.what();
    what = what.substr(what.find(']') + 2);  // removes "[json.exception...] "
    return {{}, "is not JSON (" + what + "); mend it there"};
  }
}

}  // namespace

void InputFaults::add(const std::string& problem, const std::string& why,
                      const std::string& suggestion) {
  constexpr std::size_t kMostOfAPart = 400;
  if (++count_ > kMostListed) return;
  const auto part = [](const std::string& text) { return in_a_sentence(text, kMostOfAPart); };
  sentences_.push_back(part(problem) + " (" + part(why) + "); " + part(suggestion));
}

void InputFaults::refuse(const std::string& source) const {
  if (none()) return;
  if (count_ == 1) throw UserError(Cause::bad_input, source + ": " + sentences_.front());
  throw UserError(Cause::bad_input, source + ": " + std::to_string(count_) + " faults", sentences_,
                  count_ - sentences_.size());
}

ObjectReader::ObjectReader(const Json& value, std::string where, InputFaults& faults)
    : value_(value), where_(std::move(where)), faults_(faults) {
  if (!value_.is_object()) {
    faults_.add(where_.empty() ? "the document" : where_,
                "is a JSON " + std::string(value_.type_name()), "write an object, { ... }");
  }
}

const Json* ObjectReader::find(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  if (!value_.is_object()) return nullptr;
  const auto at = value_.find(key);
  return at == value_.end() ? nullptr : &*at;
}

const Json* ObjectReader::said(const std::string& key) {
  const Json* value = find(key);
  return value && !value->is_null() ? value : nullptr;
}

void ObjectReader::require(const std::string& key, const std::string& suggestion) {
  if (value_.is_object() && !value_.contains(key)) {
    faults_.add(name(key), "is missing", suggestion);
  }
}

void ObjectReader::number(const std::string& key, double& into, double least, double most,
                          const std::string& suggestion) {
  const Json* value = find(key);
  if (!value) return;
  if (!value->is_number()) {
    faults_.add(shown(key), "must be a number", suggestion);
  } else if (const double x = value->get<double>(); !(x >= least && x <= most)) {
    faults_.add(shown(key), "must be from " + shown_number(least) + " to " + shown_number(most),
                suggestion);
  } else {
    into = x + 0.0;  // no negative zero, which would be another identity
  }
}

void ObjectReader::number(const std::string& key, std::optional<double>& into, double least,
                          double most, const std::string& suggestion) {
  const Json* value = find(key);
  if (!value) return;
  into.reset();
  if (!value->is_null()) number(key, into.emplace(least), least, most, suggestion);
}

void ObjectReader::whole(const std::string& key, std::uint64_t& into, std::uint64_t most,
                         const std::string& suggestion) {
  const Json* value = find(key);
  if (!value) return;
  if (!value->is_number_unsigned() || value->get<std::uint64_t>() > most) {
    faults_.add(shown(key), "must be a whole number from 0 to " + std::to_string(most), suggestion);
  } else {
    into = value->get<std::uint64_t>();
  }
}

void ObjectReader::count(const std::string& key, std::uint32_t& into, std::uint64_t least,
                         std::uint64_t most, const std::string& too_few) {
  const std::string suggestion = "try " + std::to_string(into);
  std::uint64_t number = into;
  const std::size_t before = faults_.count();
  whole(key, number, most, suggestion);
  if (faults_.count() == before && number < least) faults_.add(shown(key), too_few, suggestion);
  into = static_cast<std::uint32_t>(number);
}

void ObjectReader::text(const std::string& key, std::string& into, const std::string& suggestion) {
  const Json* value = find(key);
  if (!value) return;
  if (!value->is_string()) {
    faults_.add(shown(key), "must be a text", suggestion);
  } else if (const std::string text = value->get<std::string>(); printable(text) != text) {
    faults_.add(shown(key), "must be on one line, without control characters", suggestion);
  } else {
    into = text;
  }
}

void ObjectReader::boolean(const std::string& key, bool& into, const std::string& suggestion) {
  const Json* value = find(key);
  if (!value) return;
  if (!value->is_boolean()) {
    faults_.add(shown(key), "must be true or false", suggestion);
  } else {
    into = value->get<bool>();
  }
}

void ObjectReader::refuse_unknown_keys() {
  if (!value_.is_object()) return;
  for (const auto& [key, value] : value_.items()) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    faults_.add(name(key), "is not a key here",
                fmt::format("the keys are {}", fmt::join(known_, ", ")));
  }
}

std::string ObjectReader::name(const std::string& key) const {
  return where_.empty() ? key : where_ + "." + key;
}

std::string ObjectReader::shown(const std::string& key) const {
  const Json& value = value_.at(key);
  return name(key) + " = " +
         shortened(value.dump(-1, ' ', false, Json::error_handler_t::replace), 60);
}

std::string read_input_file(const std::string& path, FileKind kind) {
  std::string text = read_file(path, kLargest_bytes, kind);
  if (text.starts_with(kDatabaseHeader)) {
    throw UserError(Cause::bad_input, path +
                                          ": is a catalogue, not JSON; `misalign status` and "
                                          "`misalign replay` read those");
  }
  return text;
}

Json read_json_file(const std::string& path, FileKind kind) {
  return parse_json(read_input_file(path, kind), path);
}

Json parse_json(const std::string& text, const std::string& source) {
  ParsedText read = parsed(text);
  if (!read.why_not.empty()) throw UserError(Cause::bad_input, source + ": " + read.why_not);
  return std::move(read.json);
}

Json json_of(const Json& text) {
  return text.is_string() ? parsed(text.get_ref<const std::string&>()).json : Json();
}

std::string shown_number(double value) { return fmt::format("{:.10g}", value); }

double rounded_down(double x) {
  const double known = x * (1 + 1e-6);
  const double unit = std::pow(10, std::floor(std::log10(known)) - 1);
  return std::floor(known / unit) * unit;
}

}  // namespace misalign::schema
