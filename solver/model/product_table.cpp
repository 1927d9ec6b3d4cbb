#include "solver/model/product_table.hpp"

namespace misalign::solver {

int ProductTable::all_quads() const {
  int all = 0;
  for (int i = 0; i < coordinates; ++i) all += quads_from(i);
  return all;
}

}  // namespace misalign::solver
