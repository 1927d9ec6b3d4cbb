-- The candidates that miscuts should harm least, by the least distance (root of the sum of squares of
-- all vertices' errors, mm) to a sheet of which some diagonal stalls, to first order (results/miscut/);
-- and how many copies deploy, where `misalign tolerance` has tried.
SELECT draw, miscut_margin_mm, yield, yield_amplitude_mm, slope_min_mm_per_deg, deploys_from_deg,
       fold_limit_deg, stroke_min
FROM candidates
ORDER BY miscut_margin_mm DESC, slope_min_mm_per_deg DESC
LIMIT 20;
