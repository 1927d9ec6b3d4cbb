-- Candidates by miscut margin: the least distance (root of the sum of squares of all vertices' errors, mm)
-- to a sheet with a diagonal that stalls, to first order (results/miscut/); and their yield, where
-- `misalign tolerance` has counted it.
SELECT draw, miscut_margin_mm, yield, yield_amplitude_mm, slope_min_mm_per_deg, deploys_from_deg,
       fold_limit_deg, stroke_min
FROM candidates
ORDER BY miscut_margin_mm DESC, slope_min_mm_per_deg DESC
LIMIT 20;
