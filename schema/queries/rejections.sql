-- First faults of the rejected draws by pilot angle, in steps of 10 degrees, from the fault sample; `draws`
-- estimates their number.
WITH rejected AS (
  SELECT first_fault, fault_deg, stands_for
  FROM fault_sample
  WHERE first_fault = 'undecided' OR deploys_from_sample < (
    SELECT round(json_extract(configuration, '$.accept.deploys_from_deg')
                 / json_extract(configuration, '$.path.sample_deg')) FROM campaign)
)
SELECT first_fault, CAST(fault_deg / 10 AS INTEGER) * 10 AS from_deg, count(*) AS sampled,
       sum(stands_for) AS draws,
       CAST(sum(stands_for) AS REAL) / (SELECT sum(stands_for) FROM rejected) AS share
FROM rejected
GROUP BY first_fault, from_deg
ORDER BY first_fault, from_deg;
