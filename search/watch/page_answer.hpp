// What a request gets.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "search/watch/request_rule.hpp"

namespace misalign::search {

struct PageAnswer {
  int status = 200;
  const char* type = "";                    ///< of its content, a MIME type
  std::shared_ptr<const std::string> body;  ///< shared by all who asked at once
  std::string policy{};                     ///< Content-Security-Policy
};

/// What it throws is answered as a sentence, with status 500.
using Answerer = std::function<PageAnswer(const PageRequest&)>;

/// {"problem": sentence}.
PageAnswer problem_answer(int status, const std::string& sentence);

/// JSON, for the page's own script.
PageAnswer json_answer(int status, const std::string& json);

}  // namespace misalign::search
