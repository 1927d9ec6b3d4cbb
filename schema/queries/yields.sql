-- The miscut copies that `misalign tolerance` has tried: how many still deploy, the best first, for
-- each amplitude.
SELECT draw, amplitude_mm, trials, survivors, share, share_low, share_high, deploys_from_deg,
       miscut_margin_mm
FROM yields
ORDER BY amplitude_mm, share DESC, share_low DESC, draw
LIMIT 20;
