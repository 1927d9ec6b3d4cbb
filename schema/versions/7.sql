-- Version 7, of release 1.0.0: the layout of its catalogues. What each column is, catalogue.sql says.
PRAGMA application_id = 0x4D53414C;
PRAGMA user_version = 7;
CREATE TABLE campaign (
  id INTEGER PRIMARY KEY CHECK (id = 1),
  identity TEXT NOT NULL CHECK (length(identity) = 32),
  name TEXT NOT NULL,
  configuration TEXT NOT NULL CHECK (json_valid(configuration)),
  diagonals TEXT NOT NULL CHECK (json_valid(diagonals)),
  range_lo INTEGER NOT NULL CHECK (range_lo >= 0),
  range_hi INTEGER NOT NULL CHECK (range_hi > range_lo),
  goal_draws INTEGER CHECK (goal_draws >= 0),
  goal_accepted INTEGER CHECK (goal_accepted >= 0),
  goal_end INTEGER NOT NULL CHECK (goal_end BETWEEN range_lo AND range_hi),
  goal_relative_error REAL CHECK (goal_relative_error > 0)
) STRICT;
CREATE TABLE run (
  id INTEGER PRIMARY KEY,
  started_at TEXT NOT NULL,
  ended_at TEXT,
  end TEXT,
  host TEXT NOT NULL,
  ranks INTEGER NOT NULL CHECK (ranks >= 1),
  version TEXT NOT NULL,
  "commit" TEXT NOT NULL,
  compiler TEXT NOT NULL,
  flags TEXT NOT NULL,
  golden_verdicts TEXT NOT NULL,
  configuration TEXT NOT NULL CHECK (json_valid(configuration)),
  schema_version INTEGER NOT NULL,
  commits INTEGER,
  commit_s REAL,
  longest_commit_s REAL,
  metrics_version INTEGER NOT NULL DEFAULT 1
) STRICT;
CREATE TABLE unit (
  lo INTEGER PRIMARY KEY CHECK (lo >= 0),
  hi INTEGER NOT NULL CHECK (hi > lo),
  run INTEGER NOT NULL REFERENCES run (id),
  worker INTEGER NOT NULL CHECK (worker >= 0),
  accepted INTEGER NOT NULL CHECK (accepted >= 0),
  rejected INTEGER NOT NULL CHECK (rejected >= 0),
  undecided INTEGER NOT NULL CHECK (undecided >= 0),
  seconds REAL NOT NULL CHECK (seconds >= 0),
  digest_part BLOB NOT NULL CHECK (length(digest_part) = 16),
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
CREATE TABLE screened (
  cause TEXT NOT NULL,
  tested_deg REAL NOT NULL,
  draws INTEGER NOT NULL CHECK (draws > 0),
  PRIMARY KEY (cause, tested_deg)
) STRICT, WITHOUT ROWID;
CREATE TABLE fault_sample (
  draw INTEGER PRIMARY KEY CHECK (draw % 1024 = 0),
  unit INTEGER NOT NULL REFERENCES unit (lo),
  deploys_from_sample INTEGER NOT NULL CHECK (deploys_from_sample >= 0),
  first_fault TEXT NOT NULL,
  fault_deg REAL,
  "where" TEXT,
  stands_for INTEGER NOT NULL DEFAULT 1024 CHECK (stands_for >= 1024 AND draw % stands_for = 0)
) STRICT;
CREATE TABLE undecided (
  draw INTEGER PRIMARY KEY CHECK (draw >= 0),
  unit INTEGER NOT NULL REFERENCES unit (lo),
  cause TEXT NOT NULL,
  run INTEGER NOT NULL REFERENCES run (id)
) STRICT;
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
  slope_min_mm_per_deg REAL,
  stretch_sq_mm2 REAL NOT NULL,
  singular_value_min REAL NOT NULL,
  residual_max REAL NOT NULL,
  isometry_error_mm REAL NOT NULL,
  kawasaki_defect_deg REAL NOT NULL,
  shifted_vertices INTEGER NOT NULL,
  increasing INTEGER NOT NULL,
  decreasing INTEGER NOT NULL,
  displacements_mm TEXT NOT NULL CHECK (json_valid(displacements_mm)),
  elongation TEXT NOT NULL CHECK (json_valid(elongation)),
  slope_between_min_mm_per_deg REAL,
  bump_deg REAL,
  miscut_margin_mm REAL,
  reverses_at_deg REAL
) STRICT;
CREATE INDEX candidate_by_deploys_from ON candidate (deploys_from_sample);
CREATE INDEX candidate_best ON candidate (
  coalesce(slope_between_min_mm_per_deg < 0, 0), deploys_from_deg DESC, miscut_margin_mm DESC,
  slope_min_mm_per_deg DESC);
CREATE INDEX candidate_simplest ON candidate (shifted_vertices, deploys_from_deg DESC);
CREATE INDEX candidate_smooth ON candidate (slope_between_min_mm_per_deg DESC) WHERE bump_deg IS NULL;
CREATE INDEX candidate_stroke ON candidate (stroke_min DESC);
CREATE INDEX candidate_tolerant ON candidate (miscut_margin_mm DESC, slope_min_mm_per_deg DESC);
CREATE TABLE level (
  number INTEGER PRIMARY KEY CHECK (number >= 1),
  score INTEGER NOT NULL CHECK (score > 0),
  deploys_from_deg REAL NOT NULL
) STRICT;
CREATE TABLE population (
  unit INTEGER NOT NULL REFERENCES unit (lo),
  level INTEGER NOT NULL CHECK (level >= 0),
  particles INTEGER NOT NULL CHECK (particles > 0),
  survivors INTEGER NOT NULL CHECK (survivors BETWEEN 0 AND particles),
  ancestors INTEGER NOT NULL CHECK (ancestors BETWEEN 0 AND survivors),
  tried INTEGER NOT NULL CHECK (tried >= 0),
  taken INTEGER NOT NULL CHECK (taken BETWEEN 0 AND tried),
  undecided INTEGER NOT NULL CHECK (undecided BETWEEN 0 AND tried - taken),
  met INTEGER NOT NULL CHECK (met >= 0),
  seconds REAL NOT NULL CHECK (seconds >= 0),
  PRIMARY KEY (unit, level)
) STRICT, WITHOUT ROWID;
CREATE TABLE sheet (
  draw INTEGER PRIMARY KEY REFERENCES candidate (draw),
  hash BLOB NOT NULL CHECK (length(hash) = 16)
) STRICT;
CREATE INDEX sheet_by_hash ON sheet (hash);
CREATE TABLE piece (
  population INTEGER NOT NULL CHECK (population >= 0),
  level INTEGER NOT NULL CHECK (level >= 0),
  lo INTEGER NOT NULL CHECK (lo >= 0),
  hi INTEGER NOT NULL CHECK (hi > lo),
  layout TEXT NOT NULL,
  result BLOB NOT NULL,
  PRIMARY KEY (population, level, lo)
) STRICT, WITHOUT ROWID;
CREATE TABLE yield (
  draw INTEGER NOT NULL REFERENCES candidate (draw),
  amplitude_mm REAL NOT NULL CHECK (amplitude_mm >= 0),
  trials INTEGER NOT NULL CHECK (trials > 0),
  survivors INTEGER NOT NULL CHECK (survivors >= 0),
  undecided INTEGER NOT NULL CHECK (undecided >= 0),
  share REAL CHECK (share BETWEEN 0 AND 1),
  share_low REAL NOT NULL CHECK (share_low BETWEEN 0 AND 1),
  share_high REAL NOT NULL CHECK (share_high BETWEEN share_low AND 1),
  "commit" TEXT NOT NULL,
  made_at TEXT NOT NULL,
  PRIMARY KEY (draw, amplitude_mm),
  CHECK (survivors + undecided <= trials)
) STRICT, WITHOUT ROWID;
CREATE TABLE certificate (
  draw INTEGER PRIMARY KEY REFERENCES candidate (draw) ON DELETE CASCADE,
  certified_deg REAL NOT NULL CHECK (certified_deg BETWEEN 0 AND asked_deg),
  asked_deg REAL NOT NULL CHECK (asked_deg BETWEEN 0 AND 180),
  ended TEXT NOT NULL CHECK (ended IN ('to_the_end', 'reversal', 'over_folded', 'sign_changed', 'contact',
                                       'fold_limit', 'unclear_slope', 'flat_branch')),
  place TEXT NOT NULL,
  contact INTEGER NOT NULL CHECK (contact IN (0, 1)),
  intervals INTEGER NOT NULL CHECK (intervals >= 0),
  seconds REAL NOT NULL CHECK (seconds >= 0),
  hash TEXT NOT NULL CHECK (length(hash) = 32),
  proof BLOB NOT NULL
) STRICT;
CREATE VIEW common_yield AS
SELECT draw, amplitude_mm, share, share_low FROM yield
WHERE amplitude_mm = (SELECT amplitude_mm FROM yield GROUP BY amplitude_mm
                      ORDER BY count(*) DESC, amplitude_mm DESC LIMIT 1);
CREATE VIEW candidates AS
SELECT draw, deploys_from_deg, fold_limit_deg, miscut_margin_mm, slope_min_mm_per_deg,
       slope_between_min_mm_per_deg,
       coalesce(slope_between_min_mm_per_deg < 0, 0) AS goes_back,
       bump_deg, reverses_at_deg, stroke_min, stroke_max,
       elongation_min, elongation_max, stretch_sq_mm2, shifted_vertices, increasing, decreasing,
       kawasaki_defect_deg, singular_value_min, residual_max, isometry_error_mm,
       (SELECT share FROM common_yield WHERE common_yield.draw = candidate.draw) AS yield,
       (SELECT share_low FROM common_yield WHERE common_yield.draw = candidate.draw) AS yield_low,
       (SELECT amplitude_mm FROM common_yield WHERE common_yield.draw = candidate.draw)
         AS yield_amplitude_mm,
       (SELECT certified_deg FROM certificate WHERE certificate.draw = candidate.draw)
         AS certified_deg
FROM candidate;
CREATE VIEW yields AS
SELECT draw, amplitude_mm, trials, survivors, undecided, share, share_low, share_high,
       deploys_from_deg, miscut_margin_mm
FROM yield JOIN candidate USING (draw);
CREATE VIEW displacements AS
SELECT candidate.draw, shift.key AS vertex, json_extract(shift.value, '$[0]') AS dx_mm,
       json_extract(shift.value, '$[1]') AS dy_mm
FROM candidate, json_each(candidate.displacements_mm) AS shift;
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
CREATE VIEW faults AS
SELECT first_fault, fault_deg, count(*) AS sampled, sum(stands_for) AS draws,
       CAST(sum(stands_for) AS REAL) / (SELECT sum(stands_for) FROM fault_sample) AS share
FROM fault_sample
GROUP BY first_fault, fault_deg;
CREATE VIEW gaps AS
WITH edge (lo, previous_hi) AS (
  SELECT lo, lag(hi, 1, (SELECT range_lo FROM campaign)) OVER (ORDER BY lo)
  FROM (SELECT lo, hi FROM unit, campaign WHERE hi > range_lo AND lo < goal_end
        UNION ALL SELECT goal_end, goal_end FROM campaign)
)
SELECT previous_hi AS lo, lo AS hi FROM edge WHERE lo > previous_hi;
