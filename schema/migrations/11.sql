-- From version 10 to 11: metrics by the energy of the filling.
ALTER TABLE candidate ADD COLUMN energy_deploys_from_deg REAL;
ALTER TABLE candidate ADD COLUMN energy_friction_n_mm_per_mm REAL;

CREATE INDEX candidate_strongest ON candidate (energy_friction_n_mm_per_mm DESC);

DROP VIEW candidates;
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

PRAGMA user_version = 11;
