-- From version 3 to 4: rows of the fault sample are the rarer the larger the draw's number, and say how
-- many draws they stand for. Those that are there stay: one in 1024.
ALTER TABLE fault_sample ADD COLUMN
  stands_for INTEGER NOT NULL DEFAULT 1024 CHECK (stands_for >= 1024 AND draw % stands_for = 0);

DROP VIEW faults;
CREATE VIEW faults AS
SELECT first_fault, fault_deg, count(*) AS sampled, sum(stands_for) AS draws,
       CAST(sum(stands_for) AS REAL) / (SELECT sum(stands_for) FROM fault_sample) AS share
FROM fault_sample
GROUP BY first_fault, fault_deg;

-- What older builds measured by: version 1 before the rates of change were there, then 2; builds of
-- schema 3 may have had 3 and do not say so.
ALTER TABLE run ADD COLUMN metrics_version INTEGER NOT NULL DEFAULT 1;
UPDATE run SET metrics_version = min(schema_version, 2);

-- How far off the vertices may be cut, and what was found of copies that are.
ALTER TABLE candidate ADD COLUMN miscut_margin_mm REAL;

DROP INDEX candidate_best;
DROP INDEX candidate_robust;
CREATE INDEX candidate_best ON candidate (
  coalesce(slope_between_min_mm_per_deg < 0, 0), deploys_from_deg DESC, miscut_margin_mm DESC,
  slope_min_mm_per_deg DESC);
CREATE INDEX candidate_tolerant ON candidate (miscut_margin_mm DESC, slope_min_mm_per_deg DESC);

CREATE TABLE yield (
  draw INTEGER NOT NULL REFERENCES candidate (draw),
  amplitude_mm REAL NOT NULL CHECK (amplitude_mm >= 0),
  -- Copies 0 to trials - 1; copy t has the same errors for every candidate.
  trials INTEGER NOT NULL CHECK (trials > 0),
  survivors INTEGER NOT NULL CHECK (survivors >= 0),
  undecided INTEGER NOT NULL CHECK (undecided >= 0),
  share REAL CHECK (share BETWEEN 0 AND 1),  -- of the decided ones; null if there are none
  share_low REAL NOT NULL CHECK (share_low BETWEEN 0 AND 1),  -- 95 %; the undecided may be either
  share_high REAL NOT NULL CHECK (share_high BETWEEN share_low AND 1),
  "commit" TEXT NOT NULL,   -- of the build that judged them
  made_at TEXT NOT NULL,    -- UTC, ISO 8601
  PRIMARY KEY (draw, amplitude_mm),
  CHECK (survivors + undecided <= trials)
) STRICT, WITHOUT ROWID;

DROP VIEW candidates;
CREATE VIEW common_yield AS
SELECT draw, amplitude_mm, share, share_low FROM yield
WHERE amplitude_mm = (SELECT amplitude_mm FROM yield GROUP BY amplitude_mm
                      ORDER BY count(*) DESC, amplitude_mm DESC LIMIT 1);

CREATE VIEW candidates AS
SELECT draw, deploys_from_deg, fold_limit_deg, miscut_margin_mm, slope_min_mm_per_deg,
       slope_between_min_mm_per_deg,
       coalesce(slope_between_min_mm_per_deg < 0, 0) AS goes_back,
       bump_deg, stroke_min, stroke_max,
       elongation_min, elongation_max, stretch_sq_mm2, shifted_vertices, increasing, decreasing,
       kawasaki_defect_deg, singular_value_min, residual_max, isometry_error_mm,
       (SELECT share FROM common_yield WHERE common_yield.draw = candidate.draw) AS yield,
       (SELECT share_low FROM common_yield WHERE common_yield.draw = candidate.draw) AS yield_low,
       (SELECT amplitude_mm FROM common_yield WHERE common_yield.draw = candidate.draw)
         AS yield_amplitude_mm
FROM candidate;

CREATE VIEW yields AS
SELECT draw, amplitude_mm, trials, survivors, undecided, share, share_low, share_high,
       deploys_from_deg, miscut_margin_mm
FROM yield JOIN candidate USING (draw);

PRAGMA user_version = 4;
