-- Candidates by D, the largest first, then by miscut margin; those with a diagonal that reverses in the
-- last degree before D, or between two samples, come after all others. `export --best` and the report
-- have the same order.
SELECT draw, deploys_from_deg, fold_limit_deg, miscut_margin_mm, slope_min_mm_per_deg,
       slope_between_min_mm_per_deg, stroke_min, stroke_max, shifted_vertices
FROM candidates
ORDER BY goes_back, deploys_from_deg DESC, miscut_margin_mm DESC, slope_min_mm_per_deg DESC, draw
LIMIT 20;
