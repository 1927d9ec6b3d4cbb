// The part of `misalign actuators` that buys springs: its options, and its output.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "search/sheets/bought_springs.hpp"

namespace misalign::search {

struct PurchaseCall {
  bool wanted = false;
  std::string table;  ///< file; empty: common springs
  BuyInput input;
  std::string output;  ///< pattern file to write; empty: none
};

/// Adds --buy, and the options that need it; `design` takes the margin.
void add_purchase(CLI::App& verb, PurchaseCall& call, schema::Design& design);

/// Prints springs to buy for a sheet. UserError: bad_input of the table, check_failed where a file
/// is to be written and no springs drive the sheet.
void show_purchase(const PurchaseCall& call, const Subject& subject, bool as_json);

}  // namespace misalign::search
