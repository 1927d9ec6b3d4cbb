-- The catalogue of one campaign, version 11. Angles in degrees, lengths in mm; draws are half-open
-- ranges. No row per rejected draw: `misalign replay` makes any of them again.
PRAGMA application_id = 0x4D53414C;  -- "MSAL"
PRAGMA user_version = 11;

CREATE TABLE campaign (
  id INTEGER PRIMARY KEY CHECK (id = 1),
  identity TEXT NOT NULL CHECK (length(identity) = 32),
  name TEXT NOT NULL,
  configuration TEXT NOT NULL CHECK (json_valid(configuration)),  -- every key, as of the last run
  diagonals TEXT NOT NULL CHECK (json_valid(diagonals)),  -- [{"hole", "from", "to", "flat_mm"}] of the base
  -- The goal; the last run's wins.
  range_lo INTEGER NOT NULL CHECK (range_lo >= 0),
  range_hi INTEGER NOT NULL CHECK (range_hi > range_lo),
  goal_draws INTEGER CHECK (goal_draws >= 0),
  goal_accepted INTEGER CHECK (goal_accepted >= 0),
  goal_end INTEGER NOT NULL CHECK (goal_end BETWEEN range_lo AND range_hi),  -- draws below it count
  goal_relative_error REAL CHECK (goal_relative_error > 0)  -- of the acceptance rate
) STRICT;

-- What a run says of itself. Advice, and never checked: host, version, commit, compiler, flags, when exactly,
-- why it ended, what committing cost, what was asked of draws first. (README.md, "What is checked, and what is advice")
CREATE TABLE run (
  id INTEGER PRIMARY KEY,
  started_at TEXT NOT NULL,  -- UTC, ISO 8601
  ended_at TEXT,             -- null while it runs, and for ever if it was killed
  end TEXT,                  -- why: complete, stopped, max_time, lost (a rank fell silent), merged
  host TEXT NOT NULL,
  ranks INTEGER NOT NULL CHECK (ranks >= 1),
  version TEXT NOT NULL,
  "commit" TEXT NOT NULL,
  compiler TEXT NOT NULL,
  flags TEXT NOT NULL,
  golden_verdicts TEXT NOT NULL,  -- fingerprint of what its ranks answer on fixed draws; several if mixed
  configuration TEXT NOT NULL CHECK (json_valid(configuration)),
  schema_version INTEGER NOT NULL,  -- whose columns its rows fill
  -- What committing cost, null for a run that was killed or is from before version 3.
  commits INTEGER,
  commit_s REAL,
  longest_commit_s REAL,
  -- By which definitions its candidates are measured (solver/records/metrics.hpp). Since version 4.
  metrics_version INTEGER NOT NULL DEFAULT 1,
  -- The pilot angle of the base folding at the level of which tables turned draws away, as each machine
  -- finds it best; the largest where its ranks differ, null where none had tables. Since version 10.
  tables_deg REAL
) STRICT;

-- The ledger: ranges of draws that are done. A unit and its candidates are one transaction.
CREATE TABLE unit (
  lo INTEGER PRIMARY KEY CHECK (lo >= 0),
  hi INTEGER NOT NULL CHECK (hi > lo),
  run INTEGER NOT NULL REFERENCES run (id),
  worker INTEGER NOT NULL CHECK (worker >= 0),  -- MPI rank
  accepted INTEGER NOT NULL CHECK (accepted >= 0),
  rejected INTEGER NOT NULL CHECK (rejected >= 0),
  undecided INTEGER NOT NULL CHECK (undecided >= 0),
  seconds REAL NOT NULL CHECK (seconds >= 0),
  digest_part BLOB NOT NULL CHECK (length(digest_part) = 16),  -- sum over its candidates
  draws INTEGER GENERATED ALWAYS AS (hi - lo) VIRTUAL,
  CHECK (hi - lo = accepted + rejected + undecided)
) STRICT;

CREATE TRIGGER unit_overlaps BEFORE INSERT ON unit
WHEN (SELECT hi FROM unit WHERE lo < new.hi ORDER BY lo DESC LIMIT 1) > new.lo
BEGIN
  SELECT RAISE(ABORT, 'these draws are in the ledger already');
END;

CREATE TRIGGER unit_moves BEFORE UPDATE OF lo, hi ON unit
BEGIN
  SELECT RAISE(ABORT, 'what is in the ledger stays there');
END;

-- What the tests that judge draws saw, by cause and degree: each rejected draw once, or more often where
-- catalogues were joined. Advice: which cause and degree depends on the build, and only their sum is checked.
CREATE TABLE screened (
  cause TEXT NOT NULL,
  tested_deg REAL NOT NULL,
  draws INTEGER NOT NULL CHECK (draws > 0),
  PRIMARY KEY (cause, tested_deg)
) STRICT, WITHOUT ROWID;

-- The exact verdict of every draw with draw mod 2^k = 0: k = 10 below draw 2^27, 11 from there on, 12
-- from 2^28 on, and so forth. Units from before version 4 have a row every 1024 draws, however large.
CREATE TABLE fault_sample (
  draw INTEGER PRIMARY KEY CHECK (draw % 1024 = 0),
  unit INTEGER NOT NULL REFERENCES unit (lo),
  deploys_from_sample INTEGER NOT NULL CHECK (deploys_from_sample >= 0),
  first_fault TEXT NOT NULL,
  fault_deg REAL,  -- null when there is none
  "where" TEXT,    -- the diagonal or crease that shows it
  -- Its weight, 2^k. Since version 4.
  stands_for INTEGER NOT NULL DEFAULT 1024 CHECK (stands_for >= 1024 AND draw % stands_for = 0)
) STRICT;

CREATE TABLE undecided (
  draw INTEGER PRIMARY KEY CHECK (draw >= 0),
  unit INTEGER NOT NULL REFERENCES unit (lo),
  cause TEXT NOT NULL,
  run INTEGER NOT NULL REFERENCES run (id)  -- the build that could not tell
) STRICT;

-- Elongations and strokes are shares of a diagonal's flat length: 0.02 is 2 %.
CREATE TABLE candidate (
  draw INTEGER PRIMARY KEY CHECK (draw >= 0),
  unit INTEGER NOT NULL REFERENCES unit (lo),
  deploys_from_sample INTEGER NOT NULL CHECK (deploys_from_sample > 0),
  deploys_from_deg REAL NOT NULL,
  fold_limit_deg REAL NOT NULL,
  elongation_min REAL NOT NULL,
  elongation_max REAL NOT NULL,
  stroke_min REAL NOT NULL,
  stroke_max REAL NOT NULL,
  slope_min_mm_per_deg REAL,  -- null when it deploys from less than 5 degrees
  stretch_sq_mm2 REAL NOT NULL,
  singular_value_min REAL NOT NULL,
  residual_max REAL NOT NULL,
  isometry_error_mm REAL NOT NULL,
  kawasaki_defect_deg REAL NOT NULL,
  shifted_vertices INTEGER NOT NULL,
  increasing INTEGER NOT NULL,
  decreasing INTEGER NOT NULL,
  displacements_mm TEXT NOT NULL CHECK (json_valid(displacements_mm)),  -- {"A10": [x, y], ...}, exact
  elongation TEXT NOT NULL CHECK (json_valid(elongation)),  -- [...], of each diagonal at D
  -- Since version 2; null in rows that were written before.
  slope_between_min_mm_per_deg REAL,  -- and when it deploys from less than 6 degrees
  bump_deg REAL,  -- null when no bump was seen between two samples
  -- Since version 4; null in rows that were written before.
  miscut_margin_mm REAL,
  -- Since version 5; null in rows that were written before.
  reverses_at_deg REAL,  -- and when no diagonal turns back up to the end of its path
  -- Since version 11; null in rows that were written before.
  energy_deploys_from_deg REAL,
  energy_friction_n_mm_per_mm REAL  -- and when the energy does not fall from the threshold
) STRICT;

CREATE INDEX candidate_by_deploys_from ON candidate (deploys_from_sample);
-- What people sort by: a table of a million candidates need not be read for the best twenty.
CREATE INDEX candidate_best ON candidate (
  coalesce(slope_between_min_mm_per_deg < 0, 0), deploys_from_deg DESC, miscut_margin_mm DESC,
  slope_min_mm_per_deg DESC);
CREATE INDEX candidate_simplest ON candidate (shifted_vertices, deploys_from_deg DESC);
CREATE INDEX candidate_smooth ON candidate (slope_between_min_mm_per_deg DESC) WHERE bump_deg IS NULL;
CREATE INDEX candidate_stroke ON candidate (stroke_min DESC);
CREATE INDEX candidate_tolerant ON candidate (miscut_margin_mm DESC, slope_min_mm_per_deg DESC);
CREATE INDEX candidate_strongest ON candidate (energy_friction_n_mm_per_mm DESC);

-- Of a splitting search (search/splitting/README.md): its levels, 1, 2, ..., as scores in 1024ths of a
-- sample; the last is the campaign's criterion. Since version 6, here and below.
CREATE TABLE level (
  number INTEGER PRIMARY KEY CHECK (number >= 1),
  score INTEGER NOT NULL CHECK (score > 0),
  deploys_from_deg REAL NOT NULL
) STRICT;

-- What became of each population at each level that it came to; at level 0 of its first draws. Its unit
-- holds its numbers, 10^10 of them, of which its candidates have some.
CREATE TABLE population (
  unit INTEGER NOT NULL REFERENCES unit (lo),
  level INTEGER NOT NULL CHECK (level >= 0),
  particles INTEGER NOT NULL CHECK (particles > 0),
  survivors INTEGER NOT NULL CHECK (survivors BETWEEN 0 AND particles),  -- that have reached the next one
  ancestors INTEGER NOT NULL CHECK (ancestors BETWEEN 0 AND survivors),  -- first draws that these descend from
  tried INTEGER NOT NULL CHECK (tried >= 0),                     -- draws, or moves
  taken INTEGER NOT NULL CHECK (taken BETWEEN 0 AND tried),      -- moves that stayed within the level
  undecided INTEGER NOT NULL CHECK (undecided BETWEEN 0 AND tried - taken),
  met INTEGER NOT NULL CHECK (met >= 0),  -- different candidates, kept or not
  seconds REAL NOT NULL CHECK (seconds >= 0),
  PRIMARY KEY (unit, level)
) STRICT, WITHOUT ROWID;

-- By which a candidate of a search that stores sheets is known when it is met again: XXH3-128 of its
-- displacements_mm. Of a splitting search it has the least of its numbers; of an optimising one each
-- start has the sheet at which it ends.
CREATE TABLE sheet (
  draw INTEGER PRIMARY KEY REFERENCES candidate (draw),
  hash BLOB NOT NULL CHECK (length(hash) = 16)
) STRICT;

CREATE INDEX sheet_by_hash ON sheet (hash);

-- What is done of populations that are under way: particles lo to hi - 1 of one at a level. Gone once the
-- population is in the ledger.
CREATE TABLE piece (
  population INTEGER NOT NULL CHECK (population >= 0),
  level INTEGER NOT NULL CHECK (level >= 0),
  lo INTEGER NOT NULL CHECK (lo >= 0),
  hi INTEGER NOT NULL CHECK (hi > lo),
  layout TEXT NOT NULL,  -- of the result: a build that has another makes the piece again
  result BLOB NOT NULL,
  PRIMARY KEY (population, level, lo)
) STRICT, WITHOUT ROWID;

-- Of an optimising search: how each candidate came from its draw, where it starts. Values are those of
-- the campaign's goal (search.maximise), N mm per mm or mm. Since version 9.
CREATE TABLE ascent (
  draw INTEGER PRIMARY KEY REFERENCES candidate (draw) ON DELETE CASCADE,
  start_value REAL,  -- null where the draw has none, or breaks a limit: then it is kept as it is
  end_value REAL,
  steps INTEGER NOT NULL CHECK (steps >= 0),
  sheets_folded INTEGER NOT NULL CHECK (sheets_folded >= 0),
  ended TEXT NOT NULL CHECK (ended IN ('no_step_is_better', 'most_steps', 'breaks_a_limit', 'has_no_value')),
  limited_by TEXT CHECK (limited_by IS NULL OR json_valid(limited_by))  -- of free shifts: "limits" of `misalign optimise --json`
) STRICT;

-- What `misalign tolerance` found: of copies of a candidate whose vertices are off by up to
-- amplitude_mm, in x and in y, how many still deploy from from_deg. Since version 8 that may be another
-- angle than the campaign's threshold.
CREATE TABLE yield (
  draw INTEGER NOT NULL REFERENCES candidate (draw),
  amplitude_mm REAL NOT NULL CHECK (amplitude_mm >= 0),
  from_deg REAL NOT NULL CHECK (from_deg > 0),
  -- Copies 0 to trials - 1; copy t has the same errors for every candidate.
  trials INTEGER NOT NULL CHECK (trials > 0),
  survivors INTEGER NOT NULL CHECK (survivors >= 0),
  undecided INTEGER NOT NULL CHECK (undecided >= 0),
  share REAL CHECK (share BETWEEN 0 AND 1),  -- of the decided ones; null if there are none
  share_low REAL NOT NULL CHECK (share_low BETWEEN 0 AND 1),  -- 95 %; the undecided may be either
  share_high REAL NOT NULL CHECK (share_high BETWEEN share_low AND 1),
  "commit" TEXT NOT NULL,   -- of the build that judged them
  made_at TEXT NOT NULL,    -- UTC, ISO 8601
  PRIMARY KEY (draw, amplitude_mm, from_deg),
  CHECK (survivors + undecided <= trials)
) STRICT, WITHOUT ROWID;

-- What `misalign certify` has proven: that from flat to certified_deg a candidate folds in one way, and
-- its diagonals only grow or only shrink (solver/certificate/README.md). Since version 7.
CREATE TABLE certificate (
  draw INTEGER PRIMARY KEY REFERENCES candidate (draw) ON DELETE CASCADE,
  certified_deg REAL NOT NULL CHECK (certified_deg BETWEEN 0 AND asked_deg),
  asked_deg REAL NOT NULL CHECK (asked_deg BETWEEN 0 AND 180),
  ended TEXT NOT NULL CHECK (ended IN ('to_the_end', 'reversal', 'over_folded', 'sign_changed', 'contact',
                                       'fold_limit', 'unclear_slope', 'flat_branch')),
  place TEXT NOT NULL,  -- the diagonal, crease or panels at which it ends; empty where there is none
  contact INTEGER NOT NULL CHECK (contact IN (0, 1)),  -- whether it proves that no panels meet, too
  intervals INTEGER NOT NULL CHECK (intervals >= 0),   -- without the closing one
  seconds REAL NOT NULL CHECK (seconds >= 0),          -- that making it took
  -- XXH3-128 of the draw, the sheet and all columns but seconds (schema/catalogue/certificate_row.hpp).
  hash TEXT NOT NULL CHECK (length(hash) = 32),
  proof BLOB NOT NULL  -- solver/records/certificate.hpp says how
) STRICT;

-- For people.

-- Yields from the campaign's threshold, at the amplitude that most candidates were tried with (the
-- larger of equals): so that they can be compared.
CREATE VIEW common_yield AS
SELECT draw, amplitude_mm, share, share_low FROM yield
WHERE abs(from_deg - (SELECT json_extract(configuration, '$.accept.deploys_from_deg') FROM campaign)) < 1e-9
  AND amplitude_mm = (SELECT amplitude_mm FROM yield
                      WHERE abs(from_deg - (SELECT json_extract(configuration, '$.accept.deploys_from_deg')
                                            FROM campaign)) < 1e-9
                      GROUP BY amplitude_mm ORDER BY count(*) DESC, amplitude_mm DESC LIMIT 1);

-- goes_back: whether a diagonal goes back between two samples, or on the last degree before D.
-- certified_by: the criterion of certified_deg, as the proof says: of diagonals, or of energy.
CREATE VIEW candidates AS
SELECT draw, deploys_from_deg, fold_limit_deg, miscut_margin_mm, slope_min_mm_per_deg,
       slope_between_min_mm_per_deg,
       coalesce(slope_between_min_mm_per_deg < 0, 0) AS goes_back,
       bump_deg, reverses_at_deg, stroke_min, stroke_max,
       elongation_min, elongation_max, stretch_sq_mm2, energy_deploys_from_deg,
       energy_friction_n_mm_per_mm, shifted_vertices, increasing, decreasing,
       kawasaki_defect_deg, singular_value_min, residual_max, isometry_error_mm,
       (SELECT share FROM common_yield WHERE common_yield.draw = candidate.draw) AS yield,
       (SELECT share_low FROM common_yield WHERE common_yield.draw = candidate.draw) AS yield_low,
       (SELECT amplitude_mm FROM common_yield WHERE common_yield.draw = candidate.draw)
         AS yield_amplitude_mm,
       (SELECT certified_deg FROM certificate WHERE certificate.draw = candidate.draw)
         AS certified_deg,
       (SELECT CASE substr(proof, 20, 1) WHEN x'00' THEN 'diagonals' WHEN x'01' THEN 'energy' END
        FROM certificate WHERE certificate.draw = candidate.draw) AS certified_by,
       (SELECT start_value FROM ascent WHERE ascent.draw = candidate.draw) AS start_value,
       (SELECT end_value FROM ascent WHERE ascent.draw = candidate.draw) AS end_value
FROM candidate;

-- Of an optimising search: each sheet at which draws ended, under the least of their numbers, with that
-- draw's start and steps (of a row with one min() SQLite takes the other columns from where it is).
CREATE VIEW ends AS
SELECT min(draw) AS draw, count(*) AS starts, start_value, end_value, steps, ended,
       deploys_from_deg, stroke_max, miscut_margin_mm, slope_min_mm_per_deg, shifted_vertices, limited_by
FROM ascent JOIN sheet USING (draw) JOIN candidate USING (draw)
GROUP BY hash;

CREATE VIEW yields AS
SELECT draw, amplitude_mm, from_deg, trials, survivors, undecided, share, share_low, share_high,
       deploys_from_deg, miscut_margin_mm
FROM yield JOIN candidate USING (draw);

CREATE VIEW displacements AS
SELECT candidate.draw, shift.key AS vertex, json_extract(shift.value, '$[0]') AS dx_mm,
       json_extract(shift.value, '$[1]') AS dy_mm
FROM candidate, json_each(candidate.displacements_mm) AS shift;

-- Numbers of diagonals count from 0, here as in exports and the report.
CREATE VIEW diagonals AS
SELECT candidate.draw, diagonal.key AS diagonal,
       json_extract(diagonal.value, '$.hole[0]') AS hole_row,
       json_extract(diagonal.value, '$.hole[1]') AS hole_column,
       json_extract(diagonal.value, '$.from') AS from_vertex,
       json_extract(diagonal.value, '$.to') AS to_vertex,
       json_extract(candidate.elongation, '$[' || diagonal.key || ']') AS elongation,
       iif(json_extract(candidate.elongation, '$[' || diagonal.key || ']') > 0, 'increasing',
           'decreasing') AS direction
FROM candidate, campaign, json_each(campaign.diagonals) AS diagonal;

CREATE VIEW acceptance AS
SELECT coalesce(sum(draws), 0) AS draws, coalesce(sum(accepted), 0) AS accepted,
       coalesce(sum(rejected), 0) AS rejected, coalesce(sum(undecided), 0) AS undecided,
       CAST(sum(accepted) AS REAL) / sum(draws) AS rate, sum(seconds) AS worker_seconds
FROM unit;

-- Of a splitting search: each level with the mean over populations of their estimates of the share of
-- draws that deploy from it; sums over them of particles, of those that reached the next level, of the
-- first draws that these descend from, and of moves tried and taken. `misalign query acceptance` and
-- `status` have its interval as well.
CREATE VIEW ladder AS
WITH RECURSIVE way (unit, level, share) AS (
  SELECT lo, 0, 1.0 FROM unit WHERE EXISTS (SELECT 1 FROM level)
  UNION ALL
  SELECT unit, level + 1, share * survivors / particles FROM way JOIN population USING (unit, level)
  WHERE level < (SELECT max(number) FROM level)
)
SELECT way.level, (SELECT deploys_from_deg FROM level WHERE number = way.level) AS deploys_from_deg,
       sum(share) / (SELECT count(*) FROM unit) AS rate, sum(share > 0) AS populations_here,
       sum(particles) AS particles, sum(survivors) AS survivors, sum(ancestors) AS ancestors,
       sum(tried) AS tried, sum(taken) AS taken, sum(undecided) AS undecided, sum(met) AS met,
       sum(seconds) AS worker_seconds
FROM way LEFT JOIN population USING (unit, level)
GROUP BY way.level;

-- From fault_sample, an unbiased sample of the draws, accepted ones too: the rows that there are, about
-- how many draws they stand for, and the share of those.
CREATE VIEW faults AS
SELECT first_fault, fault_deg, count(*) AS sampled, sum(stands_for) AS draws,
       CAST(sum(stands_for) AS REAL) / (SELECT sum(stands_for) FROM fault_sample) AS share
FROM fault_sample
GROUP BY first_fault, fault_deg;

-- What is still to do below the goal's end.
CREATE VIEW gaps AS
WITH edge (lo, previous_hi) AS (
  SELECT lo, lag(hi, 1, (SELECT range_lo FROM campaign)) OVER (ORDER BY lo)
  FROM (SELECT lo, hi FROM unit, campaign WHERE hi > range_lo AND lo < goal_end
        UNION ALL SELECT goal_end, goal_end FROM campaign)
)
SELECT previous_hi AS lo, lo AS hi FROM edge WHERE lo > previous_hi;
