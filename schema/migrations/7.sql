-- From version 6 to 7: certificates.
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
  proof BLOB NOT NULL  -- solver/certificate/certificate.hpp says how
) STRICT;

DROP VIEW candidates;
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

PRAGMA user_version = 7;
