-- The best twenty optima of an optimising search, or ends of one by shape, the nearest first: number of
-- starts, value of the first start and of the optimum (or distances, rms, mm), and certified angle.
SELECT draw, starts, start_value, end_value, steps, ended, deploys_from_deg,
       (SELECT certified_deg FROM certificate WHERE certificate.draw = ends.draw) AS certified_deg,
       stroke_max, miscut_margin_mm, shifted_vertices
FROM ends
ORDER BY iif((SELECT json_extract(configuration, '$.search.method') FROM campaign) = 'shape', -1, 1) * end_value DESC,
         draw
LIMIT 20;
