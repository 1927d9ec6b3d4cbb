-- Candidates with the fewest shifted vertices.
SELECT draw, shifted_vertices, deploys_from_deg, slope_min_mm_per_deg
FROM candidates
ORDER BY shifted_vertices, deploys_from_deg DESC
LIMIT 20;
