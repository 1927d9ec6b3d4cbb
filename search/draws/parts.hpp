// What the rooms above a search add to it: given once, where the program starts.
#pragma once

#include <string>
#include <vector>

#include "search/draws/ascents.hpp"

namespace SQLite {
class Database;
}

namespace misalign::search {

/// The certificate of an accepted draw with these shifts (one column per vertex), from flat to D.
using CertifyDraw = std::function<schema::CertificateRecord(
    std::uint64_t draw, const Eigen::Matrix2Xd& shifts_mm, double deploys_from_deg)>;

/// A part that is null is not in this program, or not wanted here.
struct Parts {
  /// Made for a campaign and its model, which outlive what is made.
  CertifyDraw (*certifier)(const schema::Campaign& campaign, const solver::Model& model) = nullptr;
  BeginAscent ascend = nullptr;
  /// SQL functions of the studies' numbers, by the campaign of the catalogue with this path.
  void (*add_study_functions)(SQLite::Database& database, const std::string& path) = nullptr;
  void (*look_ahead)(SQLite::Database& database, const std::string& sql) = nullptr;
  std::string (*front_sql)(SQLite::Database& database, const std::vector<std::string>& words,
                           const std::string& where) = nullptr;
};

/// UserError (failure) where a part that is needed is not there; `lack` says what this program does
/// without it: "certifies nothing".
void need_part(bool is_there, const std::string& lack);

}  // namespace misalign::search
