-- From version 1 to 2: what the cubics between the samples show.
ALTER TABLE candidate ADD COLUMN slope_between_min_mm_per_deg REAL;
ALTER TABLE candidate ADD COLUMN bump_deg REAL;
ALTER TABLE run ADD COLUMN schema_version INTEGER NOT NULL DEFAULT 1;

DROP VIEW candidates;
CREATE VIEW candidates AS
SELECT draw, deploys_from_deg, fold_limit_deg, slope_min_mm_per_deg,
       slope_between_min_mm_per_deg, bump_deg, stroke_min, stroke_max,
       elongation_min, elongation_max, stretch_sq_mm2, shifted_vertices, increasing, decreasing,
       kawasaki_defect_deg, singular_value_min, residual_max, isometry_error_mm
FROM candidate;

PRAGMA user_version = 2;
