#include "schema/catalogue/ends_state.hpp"

#include "schema/catalogue/database.hpp"
#include "schema/catalogue/result_table.hpp"

namespace misalign::schema {

EndsState read_ends(SQLite::Database& database, std::uint64_t goal_end) {
  SQLite::Statement row =
      bound(database,
            "WITH ended AS (SELECT * FROM ascent WHERE draw < ?) "
            "SELECT (SELECT coalesce(json_extract(configuration, '$.search.maximise'), "
            "'shape_rms_mm') FROM campaign), "
            "(SELECT count(DISTINCT hash) FROM sheet WHERE draw < ?1), "
            "count(*) - count(start_value), max(end_value), "
            "(SELECT end_value FROM ended WHERE end_value IS NOT NULL ORDER BY end_value LIMIT 1 "
            "OFFSET (SELECT count(end_value) / 2 FROM ended)), min(end_value), "
            "(SELECT json_extract(configuration, '$.search.method') FROM campaign) FROM ended",
            goal_end);
  row.executeStep();
  const auto value = [&](int column) {
    return row.getColumn(column).isNull() ? std::nullopt
                                          : std::optional(row.getColumn(column).getDouble());
  };
  // The least distance from a shape is the best, and every start of one ends elsewhere.
  const bool is_of_shape = text_of(row.getColumn(6)) == "shape";
  return {text_of(row.getColumn(0)), draw_of(row.getColumn(1)),
          is_of_shape ? 0 : draw_of(row.getColumn(2)), value(is_of_shape ? 5 : 3), value(4)};
}

Json read_ascent(SQLite::Database& database, std::uint64_t draw) {
  return row_of_draw(database, "ascent", draw);
}

}  // namespace misalign::schema
