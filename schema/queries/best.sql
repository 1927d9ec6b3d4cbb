-- The candidates that deploy from the deepest fold, the more tolerant first among equals; those whose
-- diagonals go back on the last degree before D, or between two samples, after all others. This is the
-- order of `export --best`, of the report and of whatever else says "best".
SELECT draw, deploys_from_deg, fold_limit_deg, miscut_margin_mm, slope_min_mm_per_deg,
       slope_between_min_mm_per_deg, stroke_min, stroke_max, shifted_vertices
FROM candidates
ORDER BY goes_back, deploys_from_deg DESC, miscut_margin_mm DESC, slope_min_mm_per_deg DESC, draw
LIMIT 20;
