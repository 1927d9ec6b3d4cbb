-- Where along the folding draws fail first, in steps of 10 degrees, from the exact sample of one
-- draw in 1024.
WITH rejected AS (
  SELECT first_fault, fault_deg, count(*) AS draws
  FROM fault_sample
  WHERE first_fault = 'undecided' OR deploys_from_sample < (
    SELECT round(json_extract(configuration, '$.accept.deploys_from_deg')
                 / json_extract(configuration, '$.path.sample_deg')) FROM campaign)
  GROUP BY first_fault, fault_deg
)
SELECT first_fault, CAST(fault_deg / 10 AS INTEGER) * 10 AS from_deg, sum(draws) AS draws,
       CAST(sum(draws) AS REAL) / (SELECT sum(draws) FROM rejected) AS share
FROM rejected
GROUP BY first_fault, from_deg
ORDER BY first_fault, from_deg;
