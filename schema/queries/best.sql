-- The candidates that deploy from the deepest fold, the more robust first among equals.
SELECT draw, deploys_from_deg, fold_limit_deg, slope_min_mm_per_deg, stroke_min, stroke_max,
       shifted_vertices
FROM candidates
ORDER BY deploys_from_deg DESC, slope_min_mm_per_deg DESC
LIMIT 20;
