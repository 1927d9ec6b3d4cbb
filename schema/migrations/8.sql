-- From version 7 to 8: yields of copies that are to deploy from another angle than the campaign's
-- threshold. Those that are there are of the threshold.
DROP VIEW candidates;
DROP VIEW yields;
DROP VIEW common_yield;
CREATE TABLE yield_7 AS SELECT * FROM yield;
DROP TABLE yield;
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
INSERT INTO yield
SELECT draw, amplitude_mm,
       (SELECT json_extract(configuration, '$.accept.deploys_from_deg') FROM campaign), trials, survivors,
       undecided, share, share_low, share_high, "commit", made_at
FROM yield_7;
DROP TABLE yield_7;

CREATE VIEW common_yield AS
SELECT draw, amplitude_mm, share, share_low FROM yield
WHERE abs(from_deg - (SELECT json_extract(configuration, '$.accept.deploys_from_deg') FROM campaign)) < 1e-9
  AND amplitude_mm = (SELECT amplitude_mm FROM yield
                      WHERE abs(from_deg - (SELECT json_extract(configuration, '$.accept.deploys_from_deg')
                                            FROM campaign)) < 1e-9
                      GROUP BY amplitude_mm ORDER BY count(*) DESC, amplitude_mm DESC LIMIT 1);

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
SELECT draw, amplitude_mm, from_deg, trials, survivors, undecided, share, share_low, share_high,
       deploys_from_deg, miscut_margin_mm
FROM yield JOIN candidate USING (draw);

PRAGMA user_version = 8;
