-- The candidates whose slowest diagonal is fastest: the margin against miscuts.
SELECT draw, slope_min_mm_per_deg, deploys_from_deg, fold_limit_deg, stroke_min
FROM candidates
ORDER BY slope_min_mm_per_deg DESC
LIMIT 20;
