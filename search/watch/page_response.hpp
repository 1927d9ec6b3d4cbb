// Requests and responses of the page's server.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "search/watch/request_rule.hpp"

namespace misalign::search {

struct PageResponse {
  int status = 200;
  const char* type = "";                    ///< of its content, a MIME type
  std::shared_ptr<const std::string> body;  ///< shared by all who asked at once
  std::string policy{};                     ///< Content-Security-Policy
};

/// What it throws is answered as a sentence, with status 500.
using PageHandler = std::function<PageResponse(const PageRequest&)>;

/// {"problem": sentence}.
PageResponse problem_response(int status, const std::string& sentence);

/// JSON, for the page's own script.
PageResponse json_response(int status, const std::string& json);

}  // namespace misalign::search
