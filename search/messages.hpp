// What ranks send each other, as bytes. All ranks run the same program on the same kind of machine.
#pragma once

#include <vector>

#include "schema/unit_writer.hpp"

namespace misalign::search {

using Bytes = std::vector<char>;

Bytes pack(const schema::UnitRecord& unit);
schema::UnitRecord unpack_unit(const Bytes& bytes);

}  // namespace misalign::search
