// Declares the parts that rooms above a search add to it at the program's start.
#pragma once

#include <string>
#include <vector>

#include "search/draws/ascents.hpp"

namespace SQLite {
class Database;
}

namespace misalign::search {

/// Makes the certificate of an accepted draw with these shifts (one column per vertex), from flat
/// to D.
using CertifyDraw = std::function<schema::CertificateRecord(
    std::uint64_t draw, const Eigen::Matrix2Xd& shifts_mm, double deploys_from_deg)>;

/// Parts of the program; null if not in this program, or not needed.
struct Parts {
  /// Makes a certifier for a campaign and its model, which outlive it.
  CertifyDraw (*certifier)(const schema::Campaign& campaign, const solver::Model& model) = nullptr;
  BeginAscent ascend = nullptr;
  /// Adds SQL functions of the studies, for the campaign of the catalogue at `path`.
  void (*add_study_functions)(SQLite::Database& database, const std::string& path) = nullptr;
  void (*look_ahead)(SQLite::Database& database, const std::string& sql) = nullptr;
  std::string (*front_sql)(SQLite::Database& database, const std::vector<std::string>& words,
                           const std::string& where) = nullptr;
};

/// UserError (failure) if a part is missing; `lack` completes the sentence: "certifies nothing".
void need_part(bool is_there, const std::string& lack);

}  // namespace misalign::search
