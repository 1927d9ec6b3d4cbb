#include "schema/files/text_file.hpp"

#include "schema/files/output_file.hpp"

namespace misalign::schema {

void write_text_file(const std::string& path, const std::string& text) {
  OutputFile file = OutputFile::text(path);
  file.write(text);
  file.publish();
}

}  // namespace misalign::schema
