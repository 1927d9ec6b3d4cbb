-- The candidates that deploy from the deepest fold, the more robust first among equals.
SELECT * FROM candidates
ORDER BY deploys_from_deg DESC, slope_min_mm_per_deg DESC
LIMIT 20;
