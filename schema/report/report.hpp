// The report: one HTML page, whose text and programs are made by the build (schema/report/), and
// the data that goes into it.
#pragma once

#include "schema/catalogue/database.hpp"
#include "schema/exchange/actuators_json.hpp"
#include "solver/motion/deploy.hpp"

namespace misalign::schema {

/// What the page says of faults and metrics: {"faults": [{"name", "label", "meaning"}], "metrics":
/// [...], "columns_of_studies": [...]}, of their tables.
Json words_json();

/// What candidates_json asks.
std::string candidates_sql(std::uint64_t most, const std::vector<std::string_view>& functions);

/// Draws as texts (they may exceed 2^53), columns of the candidates view: the `most` first ones in
/// the order of the query `best`, and how many there are. With what these functions of studies say
/// of each.
Json candidates_json(SQLite::Database& database, std::uint64_t most,
                     const std::vector<std::string_view>& functions = {});

/// What was found of miscut copies of those candidates, and of `draws`: {"draw", and what
/// yield_json says}.
Json report_yields_json(SQLite::Database& database, std::uint64_t most,
                        const std::vector<std::uint64_t>& draws);

/// What was certified of them: {"draw", "certified_deg", "end", "where", "contact", "intervals"},
/// as their catalogue says; whether it is so, `misalign certify --check` knows.
Json report_certificates_json(SQLite::Database& database, std::uint64_t most,
                              const std::vector<std::uint64_t>& draws);

/// The exact first faults of the sample, {"every", "every_at_most", "rows": [{"first_fault",
/// "fault_deg", "where", "accepted", "sampled", "weight", "weight_sq"}]}: how many draws at least
/// and at most a row of the sample stands for; of rows that are alike how many were sampled, and
/// the sums of their weights and of the squares of these.
Json faults_json(SQLite::Database& database, const Campaign& campaign);

/// The unshifted sheet: vertices, panels, holes, creases, cuts, ball joints, pilot.
Json sheet_json(const Pattern& base, const solver::Mechanism& mechanism);

/// Of a sheet's path what stands beside another's: verdict, metrics, shifts, lengths in base64.
Json path_json(const FoldingView& view);

/// A draw to look at, flat first: histories, shapes and springs in base64, so that dozens of them
/// make no large page. Shapes are seen from the middle of the flat sheet, in whole numbers of
/// hundredths of a mm (more on sheets that reach farther than 320 mm).
Json detail_json(const FoldingView& view, std::uint64_t draw, bool accepted,
                 const solver::Actuation& actuation);

/// The deployment that the page shows of a released sheet: outcome, limits, and in base64 when the
/// pilot had which angle.
Json page_deployment_json(const solver::DeploymentStudy& study);

/// The page with this data. UserError (failure) if the program was built without the page.
std::string report_page(const Json& data);

/// A page that is given to a browser by a server, and may ask that server for data.
struct ServedPage {
  std::string text;
  std::string policy;  ///< its own Content-Security-Policy as the server's, who also frames nobody
};
ServedPage served_page(const Json& data);

}  // namespace misalign::schema
