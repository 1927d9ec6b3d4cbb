#include "search/verbs/purchase.hpp"

#include "schema/files/output_file.hpp"
#include "search/sheets/study_json.hpp"
#include "search/sheets/study_texts.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/options.hpp"

namespace misalign::search {

void add_purchase(CLI::App& verb, PurchaseCall& call, schema::Design& design) {
  BuyInput& input = call.input;
  auto* const buy = verb.add_flag("--buy", call.wanted,
                                  "choose springs that can be bought, each with a link of wire of "
                                  "its own length, that overcome "
                                  "the friction with the margin at every angle");
  for (const char* const of_equal_springs :
       {"--choose", "--stiffness", "--preload", "--stroke-limit"}) {
    buy->excludes(of_equal_springs);
  }
  verb.add_option("--springs", call.table,
                  "table of springs, a CSV file with the columns name, rate_n_per_mm, free_mm, "
                  "longest_mm, wire_mm, outer_mm and price [common springs]")
      ->type_name("FILE")
      ->needs(buy);
  verb.add_option_function<std::string>(
          "--least",
          [&input](const std::string& name) {
            input.goal = goal_of_purchase(name).value_or(input.goal);
          },
          "objective: number of types, then their price, or the price alone [types]")
      ->check(CLI::IsMember({"types", "price"}))
      ->type_name("OBJECTIVE")
      ->needs(buy);
  verb.add_flag("--push", input.pushes, "springs that push may be taken, too; they need guides")
      ->needs(buy);
  add_default(verb, "--link-step", input.links.step_mm, "links are multiples of this length, mm",
              within("actuators", "link_step_mm"), "MM")
      ->needs(buy);
  add_default(verb, "--least-link", input.links.least_mm, "shortest link, mm",
              within("actuators", "least_link_mm"), "MM")
      ->needs(buy);
  add_value(verb, "--margin", design.static_margin,
            "static margin over the friction [the design's, or 1]", within("wanted.static_margin"),
            "MARGIN")
      ->needs(buy);
  add_value(verb, "--thickness", design.thickness_mm,
            "thickness of the panels, mm: the margin is that of panels that bend [the design's]",
            within("thickness_mm"), "MM")
      ->needs(buy);
  verb.add_option("--output", call.output,
                  "write the sheet with these springs to this pattern file")
      ->type_name("FILE")
      ->needs(buy);
}

void show_purchase(const PurchaseCall& call, const Subject& subject, bool as_json) {
  BuyInput input = call.input;
  if (!call.table.empty()) input.table = schema::read_spring_table(call.table);
  const solver::Sheet& sheet = subject.sheet;
  const schema::SpringOrder order = bought_springs(sheet, subject.model.design(), input);
  if (as_json) {
    put_json(study_json(subject, order));
  } else {
    put("{}: {}", sheet.name(), bought_springs_text(sheet, order));
  }
  if (call.output.empty()) return;
  if (!order.choice.drives()) {
    throw schema::UserError(schema::Cause::check_failed,
                            call.output +
                                ": is not written (no springs of the table drive the sheet); name "
                                "a table with other springs, or a smaller margin");
  }
  schema::write_text_file(call.output, bought_pattern(subject, order).dump(1) + "\n");
}

}  // namespace misalign::search
