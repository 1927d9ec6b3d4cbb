// Opens and closes a catalogue: lays out a new one, migrates one of an older schema.
#include <filesystem>
#include <utility>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/campaign_check.hpp"
#include "schema/catalogue/candidate_row.hpp"
#include "schema/catalogue/catalogue.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/connection.hpp"
#include "schema/catalogue/recovery.hpp"
#include "schema/files/carried_files.hpp"
#include "schema/files/file_name.hpp"
#include "schema/files/output_file.hpp"

namespace misalign::schema {

Catalogue::Catalogue(const std::string& path, const Campaign& campaign,
                     const solver::Mechanism& mechanism, std::optional<Storage> storage,
                     Missing missing)
    : path_(end_of_links(path)),
      campaign_(campaign),
      mechanism_(mechanism),
      identity_(identity(campaign)),
      storage_(storage.value_or(file_system_of(path_).storage)),
      lacks_log_(lacks_log(path_)),
      lock_(path_, missing) {
  try {
    guarded(path_, [&] { open(missing); });
  } catch (...) {
    writer_.reset();
    log_.reset();
    database_.reset();
    if (lock_.made_the_file()) {
      std::error_code ignored;
      for (const std::string& suffix : journal_suffixes()) {
        std::filesystem::remove(path_ + suffix, ignored);
      }
      std::filesystem::remove(path_, ignored);
    }
    throw;
  }
}

void Catalogue::open(Missing missing) {
  write_leftovers_again(path_, lacks_log_);
  database_ = open_for_writing(path_, storage_,
                               campaign_.search.splitting ? kSplittingCache_kb : kCache_kb);
  log_.emplace(*database_, path_, storage_);
  const bool is_new = database_->execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0;
  if (is_new && missing == Missing::refused) throw damaged(*database_, "it is empty");
  if (!is_new) {
    check_same_campaign();
    log_->fold_in();
    migrate();
    if (lacks_log_) expect_sound_without_log(*database_, path_);
  } else {
    create();  // before the log exists: the file alone names its campaign
  }
  database_->exec(storage_ == Storage::network ? "PRAGMA journal_mode = TRUNCATE"
                                               : "PRAGMA journal_mode = WAL");
  if (is_new) sync_directory_of(path_);
  writer_.emplace(*database_, campaign_, mechanism_);
  goal_end_.emplace(goal_);
}

void Catalogue::check_same_campaign() const {
  SQLite::Statement campaign(*database_, "SELECT identity FROM campaign");
  if (!campaign.executeStep()) throw damaged(*database_, "it names no campaign");
  const std::string held = text_of(campaign.getColumn(0));
  if (held == identity_) return;
  const std::string different = differences(read_campaign_of(*database_, path_), campaign_);
  if (different.empty()) throw damaged(*database_, "its identity is not its configuration's");
  throw UserError(Cause::foreign, path_ + ": holds another campaign, " + held.substr(0, 8) +
                                      " (they differ in " + different +
                                      "); give this one a file of its own with " +
                                      parameter("catalogue"));
}

void Catalogue::check_same_builds(const RunInfo& run) const {
  SQLite::Statement other =
      bound(*database_, "SELECT \"commit\" FROM run WHERE golden_verdicts != ? LIMIT 1",
            run.golden_verdicts);
  if (!other.executeStep()) return;
  throw UserError(Cause::foreign,
                  path_ + ": this build (commit " + run.commit +
                      ") gives other verdicts on the golden draws than the one that worked on this "
                      "catalogue (commit " +
                      other.getColumn(0).getString() + "); use that build, another " +
                      parameter("catalogue") + ", or " + parameter("allow_mixed_builds") +
                      " if you know that the difference does no harm");
}

// Copies the file, then applies all migrations to the present schema, or none.
void Catalogue::migrate() {
  const int version = version_of(*database_);
  if (version == kSchemaVersion) return;
  const std::string name = path_ + ".version-" + std::to_string(version);
  std::string backup = name;
  for (int k = 2; is_taken(backup); ++k) backup = name + "-" + std::to_string(k);
  OutputFile file = OutputFile::database(backup, {path_});
  bound(*database_, "VACUUM INTO ?", plain_file_name(file.path())).exec();
  file.publish();
  SQLite::Transaction transaction(*database_);
  for (int next = version + 1; next <= kSchemaVersion; ++next) {
    database_->exec(carried_text("schema/migrations/" + std::to_string(next) + ".sql"));
  }
  transaction.commit();
}

void Catalogue::create() {
  SQLite::Transaction transaction(*database_);
  database_->exec(carried_text("schema/catalogue.sql"));
  bound(*database_,
        "INSERT INTO campaign (id, identity, name, configuration, diagonals, range_lo, range_hi, "
        "goal_end) VALUES (1, ?1, ?2, ?3, ?4, 0, ?5, ?5)",
        identity_, campaign_.name, stored_configuration(campaign_).dump(),
        diagonals_json(campaign_, mechanism_).dump(), kEndOfDraws)
      .exec();
  transaction.commit();
}

void Catalogue::close() {
  writer_.reset();
  log_.reset();
  close_as_one_file(std::move(database_), path_);
}

Catalogue::~Catalogue() {
  try {
    if (database_) close();
  } catch (const std::exception&) {  // an earlier error is on its way
  }
}

bool holds_all(const std::string& path, const Campaign& campaign, const Goal& goal) {
  std::error_code ignored;
  for (const std::string& suffix : journal_suffixes()) {
    if (std::filesystem::exists(path + suffix, ignored)) return false;  // in use
  }
  try {
    const auto database = open_for_reading(path);
    return reading(*database, [&] {
      if (version_of(*database) != kSchemaVersion) return false;
      Json held = stored_configuration(read_campaign_of(*database, path)),
           wanted = stored_configuration(campaign);
      for (Json* json : {&held, &wanted}) json->erase("stop");  // the goal is compared below
      if (held != wanted) return false;
      const CatalogueState state = read_state(*database);
      return state.identity == identity(campaign) && state.goal == goal && state.gaps.empty() &&
             !goal_fault(*database, state);
    });
  } catch (const UserError&) {  // opening it for writing reports the fault
    return false;
  }
}

}  // namespace misalign::schema
