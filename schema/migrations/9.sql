-- From version 8 to 9: ascents of an optimising search.
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

-- Each sheet at which draws ended, under the least of their numbers.
CREATE VIEW ends AS
SELECT min(draw) AS draw, count(*) AS starts, start_value, end_value, steps, ended,
       deploys_from_deg, stroke_max, miscut_margin_mm, slope_min_mm_per_deg, shifted_vertices, limited_by
FROM ascent JOIN sheet USING (draw) JOIN candidate USING (draw)
GROUP BY hash;

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
         AS certified_deg,
       (SELECT start_value FROM ascent WHERE ascent.draw = candidate.draw) AS start_value,
       (SELECT end_value FROM ascent WHERE ascent.draw = candidate.draw) AS end_value
FROM candidate;

PRAGMA user_version = 9;
