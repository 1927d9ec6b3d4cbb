#include "search/watch/page_response.hpp"

#include "schema/files/input.hpp"
#include "schema/files/printable.hpp"

namespace misalign::search {

PageResponse json_response(int status, const std::string& json) {
  return {status, "application/json; charset=utf-8", std::make_shared<const std::string>(json),
          "default-src 'none'; frame-ancestors 'none'"};
}

PageResponse problem_response(int status, const std::string& sentence) {
  return json_response(status, schema::Json({{"problem", schema::utf8(sentence)}}).dump());
}

}  // namespace misalign::search
