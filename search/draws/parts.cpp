#include "search/draws/parts.hpp"

#include "schema/files/user_error.hpp"

namespace misalign::search {

void need_part(bool is_there, const std::string& lack) {
  if (is_there) return;
  throw schema::UserError(schema::Cause::failure,
                          "this is the small program that scripts/run.sh builds first, which " +
                              lack + "; cmake --build --preset release builds the whole program");
}

}  // namespace misalign::search
