#include "search/designs/design_try.hpp"

#include <filesystem>
#include <iterator>

#include "schema/files/json_values.hpp"
#include "schema/files/output_file.hpp"

namespace misalign::search {
namespace {

using schema::Json;

constexpr std::size_t kMost_bytes = 256 << 20;
constexpr const char* kStages[] = {"rough", "refined", "optimised"};

DesignTry read_try(const Json& json) {
  DesignTry tried{json.at("how"),    {}, json.at("pattern"), json.at("why"),
                  json.at("chosen"), {}, json.at("lacks")};
  for (std::size_t stage = 0; stage < std::size(kStages); ++stage) {
    if (json.at("stage") == kStages[stage]) tried.stage = static_cast<DesignStage>(stage);
  }
  tried.score = {json.at("score"), json.at("decides"), json.at("decides_words")};
  return tried;
}

}  // namespace

Json design_try_json(const DesignTry& tried) {
  return {{"how", tried.how},           {"stage", kStages[static_cast<std::size_t>(tried.stage)]},
          {"passes", tried.passes()},   {"score", tried.score.value},
          {"decides", tried.score.key}, {"decides_words", tried.score.what},
          {"chosen", tried.chosen},     {"lacks", tried.lacks},
          {"why", tried.why},           {"pattern", tried.pattern}};
}

DesignLog::DesignLog(std::string path, std::string wish)
    : path_(std::move(path)), wish_(std::move(wish)) {
  if (path_.empty() || !std::filesystem::exists(path_)) return;
  // No input, which no output may replace.
  const Json json = schema::parse_json(schema::end_of_file(path_, kMost_bytes), path_);
  try {
    if (json.at("wish") != wish_) {
      throw schema::UserError(
          schema::Cause::bad_request,
          path_ +
              ": is of another wish or other options; name another --output, or "
              "remove that file to begin anew");
    }
    for (const auto& [step, tries] : json.at("steps").items()) {
      for (const Json& tried : tries) steps_[step].push_back(read_try(tried));
    }
  } catch (const Json::exception&) {
    throw schema::UserError(schema::Cause::bad_input,
                            path_ +
                                ": is no list of designs that `misalign design` wrote; name "
                                "another --output, or remove that file");
  }
}

const std::vector<DesignTry>* DesignLog::find(const std::string& step) const {
  const auto at = steps_.find(step);
  return at == steps_.end() ? nullptr : &at->second;
}

void DesignLog::add(const std::string& step, std::vector<DesignTry> tries) {
  steps_[step] = std::move(tries);
  if (path_.empty()) return;
  Json steps = Json::object();
  for (const auto& [name, of_step] : steps_) {
    steps[name] = schema::json_list(of_step, design_try_json);
  }
  schema::write_text_file(path_, Json{{"wish", wish_}, {"steps", std::move(steps)}}.dump(1) + "\n");
}

}  // namespace misalign::search
