-- Yields of miscut copies that `misalign tolerance` has counted, the best twenty of each amplitude and
-- angle.
SELECT draw, amplitude_mm, from_deg, trials, survivors, share, share_low, share_high, deploys_from_deg,
       miscut_margin_mm
FROM (SELECT *, row_number() OVER (PARTITION BY amplitude_mm, from_deg
                                   ORDER BY share DESC, share_low DESC, draw) AS place
      FROM yields)
WHERE place <= 20
ORDER BY amplitude_mm, from_deg, place;
