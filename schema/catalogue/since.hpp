// The schema version since which a catalogue has each thing.
#pragma once

#include <string>

namespace misalign::schema {

inline constexpr int kYieldSince = 4;        ///< table yield
inline constexpr int kSplittingSince = 6;    ///< tables level, population, sheet, piece
inline constexpr int kCertificateSince = 7;  ///< table certificate
inline constexpr int kYieldAngleSince = 8;   ///< column from_deg of yield
inline constexpr int kAscentSince = 9;       ///< table ascent

/// The campaign's threshold, in SQL.
inline constexpr const char* kThresholdSql =
    "(SELECT json_extract(configuration, '$.accept.deploys_from_deg') FROM campaign)";

/// A column in SQL, its name in quotes; of a catalogue of an older schema, which has no such
/// column, what is to be read in its place.
std::string column_sql(const std::string& table, const std::string& column, int schema_version);

/// ", NULL AS name, ..." for the columns of `candidate` that came after this version; may be empty.
std::string later_candidate_columns_sql(int schema_version);

}  // namespace misalign::schema
