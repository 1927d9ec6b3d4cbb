-- Candidates with the largest least stroke of their diagonals.
SELECT draw, stroke_min, stroke_max, elongation_min, elongation_max, deploys_from_deg
FROM candidates
ORDER BY stroke_min DESC
LIMIT 20;
