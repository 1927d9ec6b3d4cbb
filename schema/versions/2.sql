-- The catalogue of one campaign, version 2. Angles in degrees, lengths in mm; draws are half-open
-- ranges. No row per rejected draw: `misalign replay` makes any of them again.
PRAGMA application_id = 0x4D53414C;  -- "MSAL"
PRAGMA user_version = 2;

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
  goal_end INTEGER NOT NULL CHECK (goal_end BETWEEN range_lo AND range_hi)  -- draws below it count
) STRICT;

CREATE TABLE run (
  id INTEGER PRIMARY KEY,
  started_at TEXT NOT NULL,  -- UTC, ISO 8601
  ended_at TEXT,             -- null while it runs, and for ever if it was killed
  end TEXT,                  -- why: complete, stopped, max_time
  host TEXT NOT NULL,
  ranks INTEGER NOT NULL CHECK (ranks >= 1),
  version TEXT NOT NULL,
  "commit" TEXT NOT NULL,
  compiler TEXT NOT NULL,
  flags TEXT NOT NULL,
  golden_verdicts TEXT NOT NULL,  -- fingerprint of what this build answers on fixed draws
  configuration TEXT NOT NULL CHECK (json_valid(configuration)),
  schema_version INTEGER NOT NULL  -- whose columns its rows fill
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

-- What the tests that judge draws saw, by cause and degree. Advisory: it depends on the build.
CREATE TABLE screened (
  cause TEXT NOT NULL,
  tested_deg REAL NOT NULL,
  draws INTEGER NOT NULL CHECK (draws > 0),
  PRIMARY KEY (cause, tested_deg)
) STRICT, WITHOUT ROWID;

-- The exact verdict of every draw with draw mod 1024 = 0.
CREATE TABLE fault_sample (
  draw INTEGER PRIMARY KEY CHECK (draw % 1024 = 0),
  unit INTEGER NOT NULL REFERENCES unit (lo),
  deploys_from_sample INTEGER NOT NULL CHECK (deploys_from_sample >= 0),
  first_fault TEXT NOT NULL,
  fault_deg REAL,  -- null when there is none
  "where" TEXT     -- the diagonal or crease that shows it
) STRICT;

CREATE TABLE undecided (
  draw INTEGER PRIMARY KEY CHECK (draw >= 0),
  unit INTEGER NOT NULL REFERENCES unit (lo),
  cause TEXT NOT NULL,
  run INTEGER NOT NULL REFERENCES run (id)  -- the build that could not tell
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
  bump_deg REAL  -- null when no bump was seen between two samples
) STRICT;

CREATE INDEX candidate_by_deploys_from ON candidate (deploys_from_sample);

-- For people.

CREATE VIEW candidates AS
SELECT draw, deploys_from_deg, fold_limit_deg, slope_min_mm_per_deg,
       slope_between_min_mm_per_deg, bump_deg, stroke_min, stroke_max,
       elongation_min, elongation_max, stretch_sq_mm2, shifted_vertices, increasing, decreasing,
       kawasaki_defect_deg, singular_value_min, residual_max, isometry_error_mm
FROM candidate;

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

-- From fault_sample: an unbiased 1 in 1024 of the draws, accepted ones too.
CREATE VIEW faults AS
SELECT first_fault, fault_deg, count(*) AS draws,
       CAST(count(*) AS REAL) / (SELECT count(*) FROM fault_sample) AS share
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
