// Defines the responses of the page's server.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "search/watch/request_rule.hpp"

namespace misalign::search {

struct PageResponse {
  int status = 200;
  const char* type = "";                    ///< MIME type of the body
  std::shared_ptr<const std::string> body;  ///< shared by simultaneous requests
  std::string policy{};                     ///< Content-Security-Policy
};

/// Answers a request; an exception becomes a sentence with status 500.
using PageHandler = std::function<PageResponse(const PageRequest&)>;

/// Returns {"problem": sentence}.
PageResponse problem_response(int status, const std::string& sentence);

/// Returns JSON for the page's script.
PageResponse json_response(int status, const std::string& json);

}  // namespace misalign::search
