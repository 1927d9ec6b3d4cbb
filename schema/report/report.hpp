// Writes the report: one HTML page, which the build makes of schema/report/, with its data.
#pragma once

#include "schema/catalogue/database.hpp"
#include "schema/exchange/actuators_json.hpp"
#include "solver/motion/deploy.hpp"

namespace misalign::schema {

/// Names, labels and meanings for the page: {"faults": [{"name", "label", "meaning"}], "metrics":
/// [...], "columns_of_studies": [...]}.
Json words_json();

/// The query of candidates_json.
std::string candidates_sql(std::uint64_t most, const std::vector<std::string_view>& functions);

/// Columns of the candidates view for the `most` first candidates by the query `best`, with these
/// functions of studies, and the total count. Draws are texts: they may exceed 2^53.
Json candidates_json(SQLite::Database& database, std::uint64_t most,
                     const std::vector<std::string_view>& functions = {});

/// Yields of those candidates and of `draws`: {"draw", and the keys of yield_json}.
Json report_yields_json(SQLite::Database& database, std::uint64_t most,
                        const std::vector<std::uint64_t>& draws);

/// Their certificates: {"draw", "certified_deg", "end", "where", "contact", "intervals"}, as
/// stored; `misalign certify --check` checks them.
Json report_certificates_json(SQLite::Database& database, std::uint64_t most,
                              const std::vector<std::uint64_t>& draws);

/// The exact first faults of the sample, {"every", "every_at_most", "rows": [{"first_fault",
/// "fault_deg", "where", "accepted", "sampled", "weight", "weight_sq"}]}: the least and
/// the largest weight of a sampled draw; for equal rows their count, and the sums of their weights
/// and of these squared.
Json faults_json(SQLite::Database& database, const Campaign& campaign);

/// The unshifted sheet: vertices, panels, holes, creases, cuts, ball joints, pilot.
Json sheet_json(const Pattern& base, const solver::Mechanism& mechanism);

/// Data for the comparison of sheets: verdict, metrics, shifts, lengths in base64.
Json path_json(const FoldingView& view);

/// The details of a draw, flat first: histories, shapes and springs in base64, for small pages.
/// Shapes are relative to the middle of the flat sheet, in whole hundredths of a mm (coarser on
/// sheets that reach farther than 320 mm).
Json detail_json(const FoldingView& view, std::uint64_t draw, bool accepted,
                 const solver::Actuation& actuation);

/// The deployment of a released sheet: outcome, limits, and the pilot angle over time in base64.
Json page_deployment_json(const solver::DeploymentStudy& study);

/// The page with this data. UserError (failure) if the program was built without the page.
std::string report_page(const Json& data);

/// A page that a server gives to a browser, and that may ask the server for data.
struct ServedPage {
  std::string text;
  std::string policy;  ///< the server's Content-Security-Policy: the page's, and no frames
};
ServedPage served_page(const Json& data);

}  // namespace misalign::schema
