-- Candidates without a bump between samples, by their least slope at and between samples.
SELECT draw, slope_between_min_mm_per_deg, deploys_from_deg, fold_limit_deg, stroke_min
FROM candidates
WHERE bump_deg IS NULL AND slope_between_min_mm_per_deg IS NOT NULL
ORDER BY slope_between_min_mm_per_deg DESC
LIMIT 20;
