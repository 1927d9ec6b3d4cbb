-- Candidates with the largest critical friction from the threshold, by the energy of the filling.
SELECT draw, energy_friction_n_mm_per_mm, energy_deploys_from_deg, deploys_from_deg, stroke_max,
       miscut_margin_mm
FROM candidates
WHERE energy_friction_n_mm_per_mm IS NOT NULL
ORDER BY energy_friction_n_mm_per_mm DESC, draw
LIMIT 20;
