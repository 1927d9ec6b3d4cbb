#include "tests/simulation/campaigns.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "schema/campaign/campaign_file.hpp"
#include "schema/campaign/draw_ranges.hpp"
#include "schema/catalogue/catalogue.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "schema/files/file_bytes.hpp"
#include "search/verbs/cli.hpp"
#include "tests/older_catalogues.hpp"

namespace misalign::simulation {
namespace {

using schema::Json;

constexpr double kThreshold_samples = 30;  // 150 degrees in samples of 5

Json base_file(std::uint64_t campaign_seed) {
  return {{"name", "told"},
          {"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}},
          {"path", {{"sample_deg", 5}}},
          {"accept", {{"deploys_from_deg", 150}}},
          {"seed", campaign_seed}};
}

// A mean depth with which this share of draws deploys.
double mean_samples(double acceptance) { return -kThreshold_samples / std::log(acceptance); }

// Campaigns are read once for all seeds of a driver; their random seeds are few.
schema::Campaign read_once(const Json& file) {
  static std::map<std::string, schema::Campaign> known;
  const std::string text = file.dump();
  const auto at = known.find(text);
  if (at != known.end()) return at->second;
  return known.emplace(text, schema::read_campaign(file, "a story")).first->second;
}

Told older_story(Random& random) {
  const auto count = std::size(kOlderCatalogues);
  const OlderCatalogue& older = kOlderCatalogues[up_to(random, count)];
  static std::map<std::string, std::pair<schema::Campaign, std::uint64_t>> known;
  auto at = known.find(older.path());
  if (at == known.end()) {
    const auto database = schema::open_for_reading(older.path());
    const auto units = schema::units_done(*database);
    at = known
             .emplace(older.path(), std::pair(schema::read_campaign_of(*database, older.path()),
                                              schema::united(units).front().hi))
             .first;
  }
  Told told{.kind = "older",
            .work = Work::migration,
            .file = {},
            .campaign = at->second.first,
            .goal = 0};
  told.is_split = told.campaign.search.splitting.has_value();
  told.file = schema::campaign_json(told.campaign);
  const std::uint64_t done = at->second.second;
  told.goal = told.is_split ? done / schema::kNumbersOfPopulation : done + 20;
  told.older_version = older.version;
  told.older_path = older.path();
  return told;
}

}  // namespace

std::vector<std::string> Told::search_words(const std::string& catalogue, std::uint64_t lo,
                                            std::uint64_t hi) const {
  std::vector<std::string> words = {"search", "told.json", "--catalogue", catalogue,
                                    "--allow-mixed-builds"};
  if (lo > 0 || hi < goal) {
    words.insert(words.end(), {"--range", fmt::format("{}:{}", lo, hi)});
  } else if (!campaign.stop.accepted) {
    words.insert(words.end(), {is_split ? "--populations" : "--draws", std::to_string(goal)});
  }
  return words;
}

Told told_by(std::uint64_t seed, Random& random) {
  const std::uint64_t campaign_seed = 1 + up_to(random, 16);
  const std::uint64_t die = up_to(random, 100);
  if (seed % 1000 == 999) {
    Told told{.kind = "real",
              .work = Work::unit,
              .file = base_file(campaign_seed),
              .campaign = {},
              .goal = 60};
    told.campaign = read_once(told.file);
    told.tempo.is_real = true;
    return told;
  }
  if (die < 6) return older_story(random);
  Told told{.kind = "plain",
            .work = Work::unit,
            .file = base_file(campaign_seed),
            .campaign = {},
            .goal = 0};
  told.goal = std::array{40, 150, 400, 900}[up_to(random, 4)];
  const double acceptance = std::array{0.02, 0.1, 0.3}[up_to(random, 3)];
  told.tempo.mean_samples = mean_samples(acceptance);
  told.tempo.path_s = std::array{0.002, 0.01, 0.04}[up_to(random, 3)];
  if (die < 16) {
    told.kind = "optimising";
    told.work = Work::ascent;
    told.file["search"] = {
        {"method", "optimise"}, {"maximise", "critical_friction_n_mm_per_mm"}, {"from_deg", 36}};
    told.goal = std::array{30, 80}[up_to(random, 2)];
  } else if (die < 30) {
    told.kind = "splitting";
    told.work = Work::piece;
    told.is_split = true;
    told.file["search"] = {
        {"method", "splitting"}, {"sweeps", 2u}, {"particles", 60u}, {"first_draws", 200u}};
    if (happens(random, 0.5)) told.file["search"]["levels_deg"] = {60, 105, 150};
    // Few sheets, which populations share.
    if (happens(random, 0.5)) told.file["misalignment"] = {{"vertices", {"A7", "A8"}}};
    told.goal = 1 + up_to(random, 4);
    told.tempo.mean_samples = mean_samples(0.02);
    told.tempo.path_s = 0.002;
  } else if (die < 45) {
    told.kind = "certified";
    told.work = Work::certificate;
    told.file["certify"] = true;
    told.goal = std::array{40, 120}[up_to(random, 2)];
  } else if (die < 52) {
    told.kind = "parallel";
    told.file["misalignment"] = {{"kind", "parallel"}, {"vertices", "all"}, {"amplitude_mm", 4}};
    told.tempo.samples = 35;  // 180 degrees is no sample of the family
  } else if (die < 58) {
    told.kind = "accepted";
    told.tempo.mean_samples = mean_samples(0.003);
    told.tempo.path_s = 0.001;
    told.file["stop"] = {{"accepted", 1 + up_to(random, 12)}};
    told.goal = 8192;
  }
  told.campaign = read_once(told.file);
  const double per_draw_s = told.tempo.path_s * (told.kind == "optimising" ? 3 : 0.3);
  told.expected_s = (told.is_split ? 2.0 : static_cast<double>(told.goal) * per_draw_s) + 0.5;
  return told;
}

Told plain_story() {
  Told told{.kind = "plain", .work = Work::unit, .file = base_file(1), .campaign = {}, .goal = 40};
  told.campaign = read_once(told.file);
  told.tempo.mean_samples = mean_samples(0.3);
  return told;
}

std::string bytes_of_file(const std::string& path) {
  constexpr std::size_t kMost_bytes = std::size_t{1} << 30;
  return schema::read_file(path, kMost_bytes, schema::FileKind::regular);
}

std::function<int(int)> program(const std::vector<std::string>& words) {
  return [words](int) {
    std::vector<std::string> typed = words;
    typed.insert(typed.begin(), "misalign");
    std::vector<char*> pointers;
    for (std::string& word : typed) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const auto verbs = [](const search::Words& its_words, const search::Parts& parts) {
      using search::Verb;
      std::vector<Verb> some = search::first_verbs(its_words, parts);
      some.push_back({"verify", search::verify_verb});
      some.push_back(
          {"certify", [&](CLI::App& verb) { return search::certify_verb(verb, its_words); }});
      some.push_back({"merge", search::merge_verb});
      some.push_back({"tolerance", search::tolerance_verb});
      some.push_back({"export", search::export_verb});
      return some;
    };
    return search::run_command_line(static_cast<int>(typed.size()), pointers.data(),
                                    invented_parts(), verbs);
  };
}

void warm_up(Disk& disk) {
  for (const OlderCatalogue& older : kOlderCatalogues) schema::open_for_reading(older.path());
  const schema::Campaign campaign = read_once(base_file(1));
  const auto mechanism = solver::build_mechanism(campaign.pattern.base);
  schema::Catalogue(disk.folder() + "/warm.db", campaign, mechanism).close();
  schema::open_for_reading(disk.folder() + "/warm.db");
}

Json answer_of(const LifeEnd& end) {
  Json seen = Json::parse(end.out, nullptr, false);
  if (seen.is_discarded()) return {{"wrong", "a reader ended without an answer: " + end.err}};
  return seen;
}

const Expected& expected_of(const Told& told, Disk& disk) {
  static std::map<std::string, Expected> known;
  const std::string key = fmt::format("{} {} {} {}", told.file.dump(), told.older_path, told.goal,
                                      told.tempo.mean_samples);
  const auto at = known.find(key);
  if (at != known.end()) return at->second;
  const bool is_plain = !told.is_split && told.older_version == 0 && !told.tempo.is_real &&
                        !told.campaign.search.has_ends();
  if (is_plain) return known[key] = plain_loop(told.campaign, told.goal);
  disk.clear();
  disk.put("told.json", told.file.dump());
  if (told.older_version) disk.put("told.db", bytes_of_file(told.older_path));
  const LifeEnd end = run_through(disk, {program(told.search_words("told.db", 0, told.goal))});
  const Json seen = answer_of(run_through(disk, {looking_at("told.db", told.campaign, nullptr)}));
  if (end.code != 0 || seen.contains("wrong") || !seen.contains("digest")) {
    throw std::runtime_error("an undisturbed run fails: " + end.err + seen.dump());
  }
  Expected expected;
  for (const std::uint64_t draw : seen["accepted"]) expected.accepted.insert(draw);
  for (const std::uint64_t draw : seen["undecided"]) expected.undecided.insert(draw);
  expected.goal_end = seen["goal_end"];
  for (const Json& unit : seen["done"])
    expected.end = std::max<std::uint64_t>(expected.end, unit[1]);
  expected.digest = seen["digest"];
  // Populations that share a sheet hand it on to the first.
  if (told.is_split) expected.end = 0;
  return known[key] = expected;
}

}  // namespace misalign::simulation
