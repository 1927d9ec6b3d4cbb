-- Where the draws of an optimising search ended, the best twenty sheets: how many draws came there, from
-- what the first of them was worth to what it is worth, and the angle up to which it is certified.
SELECT draw, starts, start_value, end_value, steps, ended, deploys_from_deg,
       (SELECT certified_deg FROM certificate WHERE certificate.draw = ends.draw) AS certified_deg,
       stroke_max, miscut_margin_mm, shifted_vertices
FROM ends
ORDER BY end_value DESC, draw
LIMIT 20;
