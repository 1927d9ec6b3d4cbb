#include "search/watch/page_answer.hpp"

#include "schema/files/input.hpp"
#include "schema/files/printable.hpp"

namespace misalign::search {

PageAnswer json_answer(int status, const std::string& json) {
  return {status, "application/json; charset=utf-8", std::make_shared<const std::string>(json),
          "default-src 'none'; frame-ancestors 'none'"};
}

PageAnswer problem_answer(int status, const std::string& sentence) {
  return json_answer(status, schema::Json({{"problem", schema::utf8(sentence)}}).dump());
}

}  // namespace misalign::search
